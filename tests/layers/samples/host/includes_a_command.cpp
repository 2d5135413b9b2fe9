// Breaks a rule on purpose: a program is not the library of another.
#include "samples/cli/command.h"
