<<<<<<< HEAD
<<<<<<< HEAD
seautils_module(NAME stream SOURCES fifo.cpp hex.cpp input.cpp output.cpp packet_socket.cpp whole_file.cpp DEPENDS core)
=======
seautils_module(NAME stream SOURCES fifo.cpp hex.cpp input.cpp nmea.cpp output.cpp packet_socket.cpp
  DEPENDS core)
>>>>>>> modem
=======
seautils_module(NAME stream SOURCES fifo.cpp hex.cpp input.cpp nmea.cpp output.cpp packet_socket.cpp pty.cpp DEPENDS core)
>>>>>>> sim
