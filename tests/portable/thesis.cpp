// The codecs of the thesis, and what they and ours have in common, in one translation unit: see mix.cpp.
// The rest of the module (frames, packets, …) is not about the bits of codecs.
#include "seautils/position/thesis.cpp"
#include "seautils/core/text.cpp"
#include "seautils/entropy/arithmetic.cpp"
#include "seautils/entropy/bits.cpp"
#include "seautils/entropy/model.cpp"
#include "seautils/position/codec.cpp"
#include "seautils/position/delta_model.cpp"
#include "seautils/position/fixed_observer.cpp"
#include "seautils/position/kalman_observer.cpp"
#include "seautils/position/plan_model.cpp"
#include "seautils/position/state_bytes.cpp"
