// The files that are open, and the cases that they make up: a scene, a cell, and what is said about them.
import { KINDS } from '../kinds/index.js';
import { flaw, Flaw } from './flaw.js';
import { embeddedMesh } from './mesh_bytes.js';
import { parseObj, parseOff } from './obj_off.js';
import { parsePly, parseStl } from './ply_stl.js';

const MESHES = {
  obj: (bytes, file, full) => parseObj(new TextDecoder().decode(bytes), file, full),
  off: (bytes, file, full) => parseOff(new TextDecoder().decode(bytes), file, full),
  ply: parsePly,
  stl: parseStl,
};
const extension = (path) => path.split('.').pop().toLowerCase();
const nameOf = (path) => path.split('/').pop();
const folderOf = (path) => path.slice(0, path.length - nameOf(path).length);

async function sha256(bytes) {
  if (!globalThis.crypto?.subtle) return null;  // not everywhere; then names and counts must do
  const sum = new Uint8Array(await crypto.subtle.digest('SHA-256', bytes));
  return [...sum].map((b) => b.toString(16).padStart(2, '0')).join('');
}

function parseJson(file) {
  if (file.json === undefined) {
    try {
      file.json = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(file.bytes));
    } catch (problem) {
      throw flaw(file.path, `is no complete JSON (${problem.message})`);
    }
  }
  return file.json;
}

function parseMesh(file, full) {
  if (file.mesh) return file.mesh.points instanceof Float64Array ? file.mesh : embeddedMesh(file.mesh);
  return MESHES[extension(file.path)](file.bytes, file.path, full);
}

// Files that are no JSON are known by how they begin.
const beginOf = (file) => file.text?.slice(0, 200) ?? (file.bytes ? new TextDecoder('latin1').decode(file.bytes.subarray(0, 200)) : '');
const kindByBegin = (file) => KINDS.find((k) => k.begins?.test(beginOf(file)));

const isJson = (file) => file.json !== undefined || extension(file.path) === 'json' || (extension(file.path) !== 'gltf' && /^\s*\{/.test(beginOf(file)));

const sameCell = (a, b) => JSON.stringify([...a].sort(byPlace)) === JSON.stringify([...b].sort(byPlace));
const byPlace = (p, q) => p[0] - q[0] || p[1] - q[1] || p[2] - q[2];

export class Workspace {
  constructor() {
    this.scenes = [];
    this.parts = [];
    this.cases = [];
  }
  // Takes what can be read, and returns sentences about the rest.
  async add(files) {
    const flaws = [], taken = new Set();
    const attempt = async (work) => {
      try { await work(); } catch (problem) {
        if (!(problem instanceof Flaw)) throw problem;
        flaws.push(problem.message);
      }
    };
    const folders = files.filter((f) => nameOf(f.path) === 'finding.json');
    for (const file of folders) {
      taken.add(file);
      await attempt(() => this.addFolder(file, files, taken));
    }
    for (const file of files) {
      if (taken.has(file)) continue;
      if (kindByBegin(file)) await attempt(() => this.addFile(file));
      else if (isJson(file)) await attempt(() => this.addJson(file));
      else if (file.mesh || MESHES[extension(file.path)]) await attempt(async () => this.scenes.push({ name: nameOf(file.path), mesh: parseMesh(file, true), sha256: file.sha256 ?? (await sha256(file.bytes)) }));
      else if (!folders.some((f) => file.path.startsWith(folderOf(f.path)))) flaws.push(`${file.path}: is no file that this page knows (of clues: *.json, bakes, walks, hierarchies; or a scene: OBJ, OFF, PLY, STL; glTF and levels are put into a page by "clues view")`);
    }
    await attempt(() => { flaws.push(...this.combine()); });
    return flaws;
  }
  kindOf(json, path) {
    const format = json?.format;
    if (typeof format !== 'string') throw flaw(path, 'is JSON, but no file of clues: it has no "format"');
    const kind = KINDS.find((k) => k.formats.includes(format));
    if (!kind) throw flaw(path, `has the format ${format}; this page shows ${KINDS.flatMap((k) => k.formats).join(', ')}`);
    return kind;
  }
  addFolder(file, files, taken) {
    const kind = this.kindOf(parseJson(file), file.path), folder = folderOf(file.path);
    const beside = (name, full) => {
      const found = files.find((f) => f.path === folder + name);
      if (!found) return null;
      taken.add(found);
      return extension(name) === 'json' ? parseJson(found) : parseMesh(found, full);
    };
    for (const part of kind.readFolder(file.json, file.path, beside)) this.parts.push({ ...part, kind, file: file.path });
  }
  addFile(file) {
    const kind = kindByBegin(file), part = kind.readBytes ? kind.readBytes(file.bytes, file) : kind.readText(file.text ?? new TextDecoder().decode(file.bytes), file);
    this.parts.push({ ...part, kind, file: file.path });
  }
  addJson(file) {
    const json = parseJson(file), kind = this.kindOf(json, file.path);
    if (kind.readFolder) throw flaw(file.path, 'is part of a finding; drop its folder');
    const read = kind.readCases ? kind.readCases(json, file.path) : [kind.read(json, file.path)];
    for (const part of read) this.parts.push({ ...part, kind, file: file.path });
  }
  // The scene that a part is about; a sentence where there is none.
  sceneOf(part) {
    const asked = part.scene, count = (s) => s.mesh.triangles.length / 3;
    const same = this.scenes.find((s) => asked.sha256 && s.sha256 === asked.sha256);
    if (same) return same;
    const named = this.scenes.find((s) => s.name === asked.file);
    if (named && asked.sha256 && named.sha256) throw flaw(part.file, `is about another version of ${asked.file}: their SHA-256 differ`);
    if (named && count(named) !== asked.triangles) throw flaw(part.file, `is about ${asked.triangles} triangles, and ${asked.file} has ${count(named)}`);
    const found = named ?? (asked.sha256 ? undefined : this.scenes.find((s) => count(s) === asked.triangles));
    if (!found) throw flaw(part.file, `is about the scene ${asked.file} (${asked.triangles} triangles); drop that file too`);
    return found;
  }
  combine() {
    const flaws = [], cases = [], order = (part) => KINDS.indexOf(part.kind);
    for (const part of [...this.parts].sort((a, b) => order(a) - order(b))) {
      try {
        if (part.scene === null) { cases.push({ scene: null, cell: [], parts: [part] }); continue; }
        const scene = part.mesh ? { name: part.scene.file, mesh: part.mesh } : this.sceneOf(part);
        const joined = !part.mesh && cases.find((c) => c.scene === scene && sameCell(c.cell, part.cell) && !c.parts.some((p) => p.kind === part.kind));
        if (joined) joined.parts.push(part);
        else cases.push({ scene, cell: part.cell, parts: [part] });
      } catch (problem) {
        if (!(problem instanceof Flaw)) throw problem;
        flaws.push(problem.message);
      }
    }
    for (const scene of this.scenes) if (!cases.some((c) => c.scene === scene)) cases.push({ scene, cell: [], parts: [] });
    for (const c of cases) c.title = c.parts.length > 0 ? c.parts.map((p) => p.kind.title(p)).join(' · ') : c.scene.name;
    this.cases = cases;
    return flaws;
  }
}
