"""One file a command: it parses, calls one pipeline function and hands the result to report."""
