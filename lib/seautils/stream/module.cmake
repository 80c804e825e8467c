seautils_module(NAME stream
  SOURCES fifo.cpp hex.cpp input.cpp nmea.cpp output.cpp packet_socket.cpp pty.cpp serial_line.cpp
    whole_file.cpp
  DEPENDS core)
