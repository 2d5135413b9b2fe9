// Breaks a rule on purpose: the verifier must not share the compiler's tables.
#include "framegraph/declare/topology.h"
