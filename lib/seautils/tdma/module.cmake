seautils_module(NAME tdma SOURCES grid.cpp cycle.cpp slot_text.cpp rule.cpp network.cpp survey.cpp
                        discovery.cpp memory_text.cpp ticker.cpp report.cpp
                DEPENDS core LINK fmt::fmt)
