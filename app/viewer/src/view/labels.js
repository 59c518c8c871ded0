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
];
export const NUMBER = Object.fromEntries(LABELS.map((label, i) => [label.id, i]));
export const GLARE = '#ff00d4';
export const LAYER_COLOURS = {
  cell: '#009e73', 'SV-ME': '#e69f00', 'SE-ME': '#f0e442', 'SE-MV': '#cc79a7',
  umbra: '#6a5acd', sight: '#00c853', chain: '#e69f00',
};
export const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
