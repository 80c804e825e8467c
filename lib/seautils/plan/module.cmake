seautils_module(NAME plan
  SOURCES
    acomms_depth.cpp
    instances.cpp
    limits.cpp
    link_csv.cpp
    loss_csv.cpp
    loss_field.cpp
    max_snr_depth.cpp
    motion.cpp
    noise.cpp
    objective.cpp
    receipt.cpp
  DEPENDS core LINK fmt::fmt)
