seautils_module(NAME sim SOURCES table.cpp track.cpp scenario.cpp scenario_values.cpp packet.cpp air.cpp water.cpp nvram.cpp fields.cpp
  sentences.cpp modem.cpp modem_commands.cpp modem_reception.cpp ocean.cpp DEPENDS core stream)
