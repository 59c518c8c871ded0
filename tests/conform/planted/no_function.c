/* A shared library without the function that is asked for. */
int clues_planted_nothing(void);
int clues_planted_nothing(void) { return 0; }
