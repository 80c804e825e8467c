seautils_module(NAME modem
  SOURCES dialog.cpp driver.cpp driver_clock.cpp driver_transmit.cpp fields.cpp line_reader.cpp
    listener.cpp outgoing.cpp replay.cpp sentences.cpp statistics.cpp
  DEPENDS core stream record LINK fmt::fmt)
