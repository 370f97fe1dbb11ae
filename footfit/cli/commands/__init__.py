"""One file for each command: it parses options, calls one function of the library and answers."""
