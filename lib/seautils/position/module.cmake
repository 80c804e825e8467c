seautils_module(NAME position
  SOURCES codec.cpp mixture.cpp track_filter.cpp analogs.cpp mixer.cpp motion.cpp predictors.cpp
    value_coder.cpp mix_model.cpp mix_codec.cpp plan_model.cpp joint_code.cpp state_bytes.cpp delta_model.cpp
    fixed_observer.cpp kalman_observer.cpp thesis.cpp
    hash.cpp horizon.cpp packet.cpp packet_filler.cpp packet_header.cpp packing.cpp receiver.cpp sender.cpp simulation.cpp track_state.cpp
    cost.cpp field.cpp fix_reader.cpp fix_writer.cpp frame.cpp grid.cpp sampling.cpp
  DEPENDS core entropy LINK PkgConfig::GEOGRAPHIC fmt::fmt simdjson::simdjson)
