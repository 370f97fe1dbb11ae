"""``.3dm``, the files of Rhino, in and out: rhino3dm works in a process of its own."""
