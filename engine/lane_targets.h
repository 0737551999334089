// Which of Highway's targets kernels are compiled for; before <hwy/highway.h> wherever that is included. All but those
// whose vectors have no size: kernels keep vectors in structs.
#pragma once

#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
