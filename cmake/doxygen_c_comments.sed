# Turns the comments of the C headers into Doxygen comments: those after a declaration on its line, and those before one.
s#([;,]) +/\* #\1 /**< #
s#^( *)/\*( |$)#\1/**\2#
