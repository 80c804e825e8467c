// The code of positions some intervals on, which are our codec's: see mix.cpp.
#include "seautils/position/horizon.cpp"
