// poscode - send a vehicle's track in a few bits a fix
#include "poscode_live.hpp"
#include "poscode_receive.hpp"
#include "poscode_simulate.hpp"
#include "poscode_stat.hpp"

#include "seautils/cli/commands.hpp"

using namespace seautils;

int main(int argc, char** argv) {
    cli::Commands poscode{"poscode", "Send a vehicle's track in a few bits a fix.",
                          "  poscode encode --tau 10 track.csv | poscode decode --tau 10\n"
                          "  poscode stat --tau 10 track.csv\n"};
    poscode.add("encode", "Pack a track into packets", tools::encode_main);
    poscode.add("decode", "Unpack the positions of packets", tools::decode_main);
    poscode.add("stat", "Say what each codec costs on a track", tools::stat_main);
    poscode.add("simulate", "Say what a track costs over a lossy link", tools::simulate_main);
    return poscode.main(argc, argv);
}
