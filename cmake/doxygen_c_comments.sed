# The comments of the C headers, as Doxygen knows them: of what follows, or of what stands before them on the line.
s#([;,]) +/\* #\1 /**< #
s#^( *)/\*( |$)#\1/**\2#
