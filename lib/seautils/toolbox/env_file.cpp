// not there yet
