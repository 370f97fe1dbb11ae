"""One module per verb: paths, arrays and a catalogue in, results out. Prints nothing."""
