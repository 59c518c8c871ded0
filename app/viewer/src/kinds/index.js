// The kinds of files that the page can show. A kind is one module with
//
//   id, formats       its name, and its "format" (several where versions differ)
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
//   rows(part)                   [{ verdict, name, note, triangle, sight: [v, p], bad }]: of the table
import conformance from './conformance.js';
import finding from './finding.js';
import judgement from './judgement.js';
import result from './result.js';
import umbra from './umbra.js';

export const KINDS = [result, judgement, finding, umbra, conformance];
