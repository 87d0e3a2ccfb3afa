/* What the programs here need of a board. */
#ifndef BOARD_H
#define BOARD_H

/* Writes to the debugger's console. */
void put(const char *text);

#endif
