// What is wrong with a file, as a sentence for the person who opened it.
export class Flaw extends Error {}

export const flaw = (file, what) => new Flaw(`${file}: ${what}`);
