// Scenario files: what may be said, and where it is wrong.
#include "seautils/core/error.hpp"
#include "sim_rig.hpp"

namespace seautils::sim {
namespace {

const std::string node = "[node a]\nid = 1\nx_m = 0\ny_m = 0\n";

Scenario parse(const std::string& text, const std::map<std::string, std::string>& files = {}) {
    return parse_scenario("s.conf", text, epoch, [&](const std::string& file) {
        const auto found = files.find(file);
        if (found == files.end()) throw Error(ExitCode::no_input, file + ": not there");
        return found->second;
    });
}

std::string fault(const std::string& text, const std::map<std::string, std::string>& files = {}) {
    try {
        parse(text, files);
    } catch (const ConfigError& e) {
        return e.what();
    }
    return "taken";
}

}  // namespace

TEST(SimScenario, EverythingThatCanBeSaid) {
    const Scenario s = parse(
        R"(# a comment
[water]
sound_speed_mps = 1482.5   # at 10 m
max_range_m = 5000
loss = 0.1
loss_by_range = 0:0, 1000:0.5
bad_crc = 0.2
source_level_db = 190
noise_db = 60
threshold_db = 0:1.5, 5:20
seed = 7
epoch = 2024-05-01T12:00:00Z
[nodes]
modem = mm1
nvram = DTO:3, CST:1
[node ship]
id = 30
x_m = -100
y_m = 50.5
depth_m = 3
clock_offset_s = -1.5
clock_drift_ppm = 20
pps = no
reboot_s = 10, 20.5
boot_s = 2
baud = 4800
[node auv-1]
id = 1
modem = mm2
firmware = 2.0.35490
nvram = DTO:9, recv.base64data:1
latitude_deg = 59.1
longitude_deg = 10.2
[transponder A]
letter = A
query_hz = 26000
reply_hz = 25000
turn_around_ms = 60
x_m = 1
y_m = 2
)");
    EXPECT_EQ(s.water.sound_speed_mps, 1482.5);
    EXPECT_EQ(s.water.max_range_m, 5000);
    EXPECT_EQ(s.water.loss_by_range.at(500), 0.25);
    EXPECT_EQ(s.water.threshold_db[0], 1.5);
    EXPECT_EQ(s.water.threshold_db[1], 4);
    EXPECT_EQ(s.seed, 7U);
    EXPECT_EQ(s.epoch, parse_utc("2024-05-01T12:00:00Z") * 1000);
    ASSERT_EQ(s.nodes.size(), 2U);
    EXPECT_EQ(s.nodes[0].generation, Generation::mm1);
    EXPECT_EQ(s.nodes[0].track.at(epoch).y_m, 50.5);
    EXPECT_EQ(s.nodes[0].track.at(epoch).depth_m, 3);
    EXPECT_EQ(s.nodes[0].reboot_s, (std::vector<double>{10, 20.5}));
    EXPECT_FALSE(s.nodes[0].pps);
    EXPECT_EQ(s.nodes[1].generation, Generation::mm2);
    EXPECT_EQ(s.nodes[1].nvram.at("DTO"), "9");
    EXPECT_EQ(s.nodes[1].nvram.at("CST"), "1") << "as all nodes have it";
    EXPECT_EQ(s.nodes[1].track.at(epoch).x_m, 0) << "it is the origin";
    ASSERT_EQ(s.transponders.size(), 1U);
    EXPECT_EQ(s.transponders[0].turn_around_ms, 60);
    EXPECT_EQ(parse(node).epoch, epoch) << "where none is given";
    EXPECT_EQ(parse("\r\n" + node + "pps = yes\r\n").nodes[0].pps, true);
}

TEST(SimScenario, FaultsAreLocatedAndQuoted) {
    EXPECT_EQ(fault(""), "s.conf: no section [node NAME]");
    EXPECT_EQ(fault("id = 1"), "s.conf:1: key 'id' stands before any section");
    EXPECT_EQ(fault("[water]\nnonsense"),
              "s.conf:2: 'nonsense' is neither 'key = value' nor '[section]'");
    EXPECT_EQ(fault("\n[watr]"), "s.conf:2: unknown section 'watr' (did you mean 'water'?)");
    EXPECT_EQ(fault("[water]\nmax_rnage_m = 1"),
              "s.conf:2: unknown key 'max_rnage_m' (did you mean 'max_range_m'?)");
    EXPECT_EQ(fault("[water]\nloss = 2"), "s.conf:2: loss '2' is outside 0 to 1");
    EXPECT_EQ(fault("[water]\nloss = much"), "s.conf:2: loss 'much' is not a number");
    EXPECT_EQ(fault("[water]\nloss ="), "s.conf:2: key 'loss' has no value");
    EXPECT_EQ(fault("[water]\nloss = 0\nloss = 0"), "s.conf:3: key 'loss' stands twice");
    EXPECT_EQ(fault("[water]\n[water]"), "s.conf:2: section [water] stands twice");
    EXPECT_EQ(fault("[water]\nsound_speed_mps = 300"),
              "s.conf:2: sound_speed_mps '300' is outside 1300 to 1700 m/s");
    EXPECT_EQ(fault("[water]\nloss_by_range = 5"),
              "s.conf:2: loss_by_range '5' is not of the form A:B, A:B");
    EXPECT_EQ(fault("[water]\nloss_by_range = 5:0, 5:1"),
              "s.conf:2: 5 follows 5: the first column must increase");
    EXPECT_EQ(fault("[water]\nthreshold_db = 7:1"), "s.conf:2: rate '7' is outside 0 to 6");
    EXPECT_EQ(fault("[water]\nthreshold_db = 1.5:1"), "s.conf:2: rate '1.5' is not a whole number");
    EXPECT_EQ(fault("[water]\nepoch = noon"),
              "s.conf:2: epoch: time 'noon' is not of the form 2024-05-01T12:00:25Z");
    EXPECT_EQ(fault("[water]\norigin = 1"),
              "s.conf:2: origin '1' is not of the form LATITUDE, LONGITUDE");
    EXPECT_EQ(fault("[node a]\nid = 31"), "s.conf:2: id '31' is outside 1 to 30");
    EXPECT_EQ(fault("[node a]\nx_m = 1\n\n"), "s.conf:3: node 'a' has no id");
    EXPECT_EQ(fault("[node a/b]"),
              "s.conf:1: node name 'a/b' is not 1 to 32 letters, digits, '-', '_' or '.'");
    EXPECT_EQ(fault("[node ..]").substr(0, 24), "s.conf:1: node name '..'");
    EXPECT_EQ(fault(node + node), "s.conf:5: name 'a' is given twice");
    EXPECT_EQ(fault(node + "[node b]\nid = 1\nx_m = 0\ny_m = 0\n"),
              "s.conf:8: nodes 'a' and 'b' have the same id 1");
    EXPECT_EQ(fault("[node a]\nid = 1\nmodem = mm3"),
              "s.conf:3: modem 'mm3' is neither mm1 nor mm2");
    EXPECT_EQ(fault(node + "pps = maybe"), "s.conf:5: pps 'maybe' is neither yes nor no");
    EXPECT_EQ(fault(node + "nvram = A*:1"),
              "s.conf:5: nvram 'A*':'1' cannot be said in a sentence");
    EXPECT_EQ(fault(node + "reboot_s = 5, 4"),
              "s.conf:5: reboot_s '4' does not come after the one before");
    EXPECT_EQ(fault(node + "[transponder t]\nletter = E"),
              "s.conf:6: letter 'E' is none of A, B, C, D");
    EXPECT_EQ(fault(node + "[transponder t]\nx_m = 1\ny_m = 1"),
              "s.conf:7: transponder 't' has neither a letter nor query_hz and reply_hz");
    EXPECT_EQ(fault("[node a\x01]").substr(0, 27), R"(s.conf:1: node name 'a\x01')");
    EXPECT_LT(fault("[water]\n" + std::string(100'000, 'k') + " = 1").size(), 300U);
    EXPECT_EQ(fault(std::string((1U << 20) + 1, ' ')), "s.conf: longer than 1 MiB");
}

TEST(SimScenario, PlacesThatDoNotFit) {
    const std::string a = "[node a]\nid = 1\n";
    EXPECT_EQ(fault(a), "s.conf: node 'a': does not say where it is: x_m and y_m, or track");
    EXPECT_EQ(fault(a + "x_m = 1"), "s.conf: node 'a': has only one of x_m and y_m");
    EXPECT_EQ(fault(a + "latitude_deg = 1"),
              "s.conf: node 'a': has only one of latitude_deg and longitude_deg");
    EXPECT_EQ(fault(a + "x_m = 1\ny_m = 1\ntrack = t.csv"),
              "s.conf: node 'a': says where it is in two ways: x_m and y_m, latitude_deg and "
              "longitude_deg, or track");
}

TEST(SimScenario, Tracks) {
    const std::string a = "[node a]\nid = 1\ntrack = t.csv\n";
    const auto of = [&](const std::string& csv) { return fault(a, {{"t.csv", csv}}); };
    const std::string place = "s.conf: node 'a': t.csv";
    EXPECT_EQ(of(""), place + ": no line of column names");
    EXPECT_EQ(of("x_m,y_m\n"), place + ": no column 'time_s'");
    EXPECT_EQ(of("time_s,x_m\n1,2\n"), place +
                                           ": neither columns 'x_m' and 'y_m' nor "
                                           "'latitude_deg' and 'longitude_deg'");
    EXPECT_EQ(of("time_s,x_m,y_m\n"), place + ": no row with a time and a position");
    EXPECT_EQ(of("time_s,x_m,y_m\n1,2\n"), place + ":2: 2 values where 3 are named");
    EXPECT_EQ(of("time_s,x_m,y_m\n# c\n\n1,2,z\n"), place + ":4: y_m 'z' is not a number");
    EXPECT_EQ(of("time_s,x_m,y_m\n1,2,3\n1,2,3\n"),
              place + ":3: time_s 1 does not come after the row before");
    EXPECT_EQ(of("time_s,lat_deg,lon_deg\n1,99,3\n"), place +
                                                          ":2: latitude_deg '99' is outside "
                                                          "-90 to 90");
    const Scenario s = parse(a + "[node b]\nid = 2\ntrack = u.csv\ntrack_time = utc\n",
                             {{"t.csv",
                               "time_s,depth_m,x_m,y_m,heading\r\n"
                               "100,0,0,0,\r\n101,,,,\r\n110,20,100,-50,7\r\n"},
                              {"u.csv",
                               "time_s,lat_deg,lon_deg\n1714596300,59,10\n"
                               "1714596400,59.001,10.001\n"}});
    const Track& track = s.nodes[0].track;
    EXPECT_EQ(track.at(epoch).x_m, 0) << "its first row is at the epoch";
    EXPECT_DOUBLE_EQ(track.at(epoch + 5 * second_ns).x_m, 50);
    EXPECT_DOUBLE_EQ(track.at(epoch + 5 * second_ns).y_m, -25);
    EXPECT_DOUBLE_EQ(track.at(epoch + 5 * second_ns).depth_m, 10);
    EXPECT_EQ(track.at(epoch + 100 * second_ns).x_m, 100) << "it stays where it ends";
    EXPECT_EQ(track.at(0).x_m, 0);
    // 0.001 degrees at 59 degrees north: 111.4 m of latitude, 57.5 m of longitude (NOAA's tables
    // of degree lengths: 111.396 km and 57.478 km at 59 degrees)
    const Position end = s.nodes[1].track.at(1714596400 * second_ns);
    EXPECT_NEAR(end.y_m, 111.396, 0.01);
    EXPECT_NEAR(end.x_m, 57.478, 0.02);
}

TEST(SimScenario, TablesOfOtherFiles) {
    const std::string water = "[water]\ntransmission_loss = tl.csv\nrates = r.txt\n";
    const Scenario s = parse(water + node, {{"tl.csv", "range_m,tl_db,more\n1,0,x\n1000,60,x\n"},
                                            {"r.txt", "data 0 1 16 2 0 0.9 0.9\n"}});
    EXPECT_EQ(s.water.tl_db.at(1000), 60);
    EXPECT_EQ(s.rates.data(0).frame_bytes, 16U);
    EXPECT_EQ(fault(water + node, {{"tl.csv", "range,tl\n"}}),
              "s.conf:2: tl.csv: no columns 'range_m' and 'tl_db'");
    EXPECT_EQ(fault(water + node, {{"tl.csv", "range_m,tl_db\n2,1\n1,1\n"}}),
              "s.conf:2: tl.csv: 1 follows 2: the first column must increase");
    EXPECT_EQ(fault(water + node, {{"tl.csv", "range_m,tl_db\n2,x\n"}}),
              "s.conf:2: tl.csv:2: tl_db 'x' is not a number");
    EXPECT_EQ(fault(water + node, {{"tl.csv", "range_m,tl_db\n2,1\n"}, {"r.txt", "data 0\n"}})
                  .substr(0, 20),
              "s.conf:3: r.txt:1: 2");
    EXPECT_THROW(parse(water + node), Error) << "a file that is not there";
}

}  // namespace seautils::sim
