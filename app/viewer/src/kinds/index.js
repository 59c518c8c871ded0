// The kinds of files that the page can show. A kind is one module with
//
//   id, name, formats its name, what its colours are of, and its "format" (several where versions differ)
//   read(json, file)  a part: { scene: {file, sha256, triangles}, cell, mode, data }; throws Flaw for what is not whole
//   title(part)       one line
//
// and any of
//
//   listed(part, t)              whether the triangle is in the list (standing in the cell draws these)
//   label(part, t)               the label of a triangle as a whole (view/labels.js)
//   regions(part)                the regions of the map
//   summary(part)                lines about all of it
//   layers(part, frame, mesh)    [{ id, name, colour, on, make() }]: things drawn besides the surface
//   facts(part, t)               [{ text, lines, ends, triangles }]: what it knows about a triangle; lines and so on are drawn
//   rows(part)                   [{ verdict, name, note, triangle, sight: [v, p], bad, goto }]: of the table; goto: the data of the part that shows it, if that is another
//
// A kind that is no JSON has `begins` (how the file begins) and readText(text, file) or readBytes(bytes, file). One that is gone through step by step (cells, frames,
// levels) has a view of its own, and keeps in part.at where one is:
//
//   view                         { id, name }
//   steps(part)                  how many steps there are
//   panel(part, app)             { title, lines, choices: [{ id, name, options: [{ id, name }], value, set }], bars: [{ values, title }], barNames, lists: [{ name, ids }],
//                                buttons: [{ name, does }], tree }: what stands beside it
//   state(part), restore(part, text)  for the address
//   cellAt(part)                 the cell that one is in
//   meshAt(part)                 the mesh that there is, where it is not the scene's
//   surface(part, frame, listed) what is coloured, where it is not whole triangles
//   eyeAt(part)                  a viewpoint to look from
//   extent(part)                 points that the picture has room for, besides the first mesh and cell
//   names(part)                  { label: name }: what labels mean here
//   alsoUsed(part)               numbers of labels that layers have
import bake from './bake.js';
import conformance from './conformance.js';
import delta from './delta.js';
import finding from './finding.js';
import judgement from './judgement.js';
import maps from './maps.js';
import result from './result.js';
import umbra from './umbra.js';
import walk from './walk.js';

export const KINDS = [result, judgement, finding, umbra, conformance, bake, delta, walk, maps];
