seautils_module(NAME queue
  SOURCES config.cpp contest.cpp fit_tree.cpp priority.cpp scheduler.cpp
  DEPENDS core LINK fmt::fmt)
