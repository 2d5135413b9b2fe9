// Breaks a rule on purpose: passes know nothing of how they are embedded.
#include "integration/registry.h"
#include "passes/temporal/reprojection.h"
