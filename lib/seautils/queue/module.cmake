seautils_module(NAME queue
  SOURCES config.cpp contest.cpp fit_tree.cpp priority.cpp scheduler.cpp spool.cpp spool_database.cpp
  DEPENDS core LINK PkgConfig::SQLITE fmt::fmt)
