// Precompiles the headers that tests share (CMakeLists.txt). As a program of its own it has no test.
