// Our codec in one translation unit, for the library's headers take longer to compile than its sources;
// thesis.cpp has the rest: some of their names, local to a file, are the same.
#include "seautils/position/analogs.cpp"
#include "seautils/position/joint_code.cpp"
#include "seautils/position/mix_codec.cpp"
#include "seautils/position/mix_model.cpp"
#include "seautils/position/mixer.cpp"
#include "seautils/position/mixture.cpp"
#include "seautils/position/motion.cpp"
#include "seautils/position/predictors.cpp"
#include "seautils/position/track_filter.cpp"
#include "seautils/position/value_coder.cpp"
