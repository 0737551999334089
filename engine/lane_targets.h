// Which of Highway's targets kernels are compiled for; before <hwy/highway.h> wherever that is included. Not those whose
// vectors have no size, because kernels keep vectors in structs, and not SSSE3: what has it and no SSE4 is from 2006.
#pragma once

#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3)
