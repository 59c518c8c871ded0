// What surface is called and how it is coloured. The colours are those of Okabe and Ito, which people with any of the usual
// kinds of colour blindness can tell apart; what is hidden is hatched as well.
export const LABELS = [
  { id: 'none', name: 'no statement', colour: '#7a7a80' },
  { id: 'visible', name: 'visible from the cell', colour: '#56b4e9' },
  { id: 'hidden', name: 'hidden', colour: '#d55e00', hatch: true },
  { id: 'away', name: 'faces away from the cell', colour: '#a9a9ad' },
  { id: 'missing-visible', name: 'missing, though visible', colour: '#ff00d4' },
  { id: 'missing-undecided', name: 'missing, undecided', colour: '#cc79a7' },
  { id: 'exact', name: 'listed, with a sight line', colour: '#0072b2' },
  { id: 'first-order', name: 'listed, no sight line found', colour: '#56b4e9' },
  { id: 'loose', name: 'listed, though hidden', colour: '#f0e442' },
  // From cell to cell.
  { id: 'both', name: 'seen from both cells', colour: '#56b4e9' },
  { id: 'from', name: 'from the first only: newly hidden', colour: '#d55e00', hatch: true },
  { id: 'to', name: 'from the second only: newly visible', colour: '#f0e442' },
  { id: 'neither', name: 'seen from neither', colour: '#8a8a90' },
  { id: 'listed', name: 'listed in this cell', colour: '#56b4e9' },
  { id: 'plus', name: '+ listed in this cell, and not in the one before', colour: '#f0e442' },
  { id: 'minus', name: '− listed in the cell before, and no more', colour: '#d55e00', hatch: true },
  { id: 'unlisted', name: 'not listed', colour: '#8a8a90' },
  // Frames of a walk.
  { id: 'due', name: 'examined: its bound was used up', colour: '#e69f00', hatch: true },
  { id: 'made', name: 'made in this frame', colour: '#0072b2' },
  { id: 'kept', name: 'as in the frame before', colour: '#c4c5ca' },
  { id: 'level', name: 'a triangle of this level', colour: '#c4c5ca' },
  ...['#00224e', '#123570', '#3b496c', '#575d6d', '#707173', '#a59c74', '#d2c060', '#fee838'].map((colour, i) => ({ id: `scale-${i}`, name: `step ${i + 1} of 8`, colour })),
  ...['#e69f00', '#56b4e9', '#009e73', '#f0e442', '#0072b2', '#d55e00', '#cc79a7', '#999999'].map((colour, i) => ({ id: `patch-${i}`, name: 'patches', colour })),
];
// Eight steps from dark blue to yellow, which get lighter all the way: they can be told apart without their hue.
export const SCALE = 8, PATCHES = 8;
export const NUMBER = Object.fromEntries(LABELS.map((label, i) => [label.id, i]));
export const GLARE = '#ff00d4';
export const LAYER_COLOURS = {
  cell: '#009e73', 'SV-ME': '#e69f00', 'SE-ME': '#f0e442', 'SE-MV': '#cc79a7',
  umbra: '#6a5acd', sight: '#00c853', chain: '#e69f00',
};
export const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
