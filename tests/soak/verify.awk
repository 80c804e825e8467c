# verify.awk - what became of each message of a soak test, and whether every stage lived
#
# Reads the facts that tests/soak/run collects, a line each; writes counts, then what is wrong. Status 1 where something is.
# -v to_sim='WARP BOOT SIM': what time it is at sea, from the seconds since the machine's start.

BEGIN {
    split(to_sim, clock, " ")
    answer_cs = 500  # a queue that takes longer to answer, stalls of half a second included, counts as hung
    step_s = 10  # its clock, which drop records have their times from, may be so wrong
    before_s = 1 + 0.1 * clock[1]  # before the death of an mm-serial: what it had read and not yet written
}

function sea(cs) { return clock[3] + clock[1] * (cs / 100 - clock[2]) }
function wrong(what) { violations[++wrongs] = what }

$1 == "offered" {
    key = $2 ":" $3
    offered[key] = 1
    ++answers[$6]
    in_vain[$2] = $6 == 0 ? 0 : in_vain[$2] + 1
    if ($6 == 0) { accepted[key] = $4; order[++n_accepted] = key }
    if ($6 == 75 || $8 - $7 > answer_cs) wrong("queue-sched of node " $2 " took " ($8 - $7) / 100 " s to answer message " key)
}
$1 == "bytes" { bytes[$2] = $3 }
$1 == "decoded" && $2 == $4 { ++decoded[$2, $3]; decoder[$3] = $2 }
$1 == "heard" { ++n_heard[$2] }
$1 == "decoded" { ++n_live[$2] }
$1 == "afresh" { ++n_afresh[$2] }
$1 == "replayed" { replayed[$2, $3] = 1 }
$1 == "dropped" {
    if ($5 != "REFUSED") {
        reason[$3] = $5
        dropped[$3, ++drops[$3]] = $4
    }
}
$1 == "left" { left[$2] += $3; told[$2] = 1 }
$1 == "slot" { if ($3 > last_slot[$2]) last_slot[$2] = $3 }
$1 == "line" { if ($3 > last_line[$2]) last_line[$2] = $3 }
$1 == "host" { host_at[$2, ++hosts[$2]] = $3 }
$1 == "said" { ++n_said; said_node[n_said] = $2; said_at[n_said] = $3; said_hex[n_said] = $4 }
$1 == "reboots" { reboots = $2; starts_of_modems = $3 }
$1 == "trouble" {
    at = sea($2)
    ++troubles[$3]
    if ($3 == "kill") { killed[$6] = 1; kill_at[$4, $5, ++kills[$4, $5]] = at; ++kills_of[$5] }
    if ($3 == "start") start_at[$4, $5, ++starts[$4, $5]] = at
    if ($3 == "full") is_full[$4] = 1
    if ($3 == "room") is_full[$4] = 0
    if ($3 == "peace") peace = at
    if ($3 == "hung") wrong($5 " of node " $4 " did not end on SIGTERM")
    if ($3 == "absent") wrong($5 " of node " $4 " was not running at the end")
    if ($3 == "end" && !($6 in killed)) {
        if (!peace && is_full[$4] && $5 == "queue-sched") ++ended_full
        else if (!peace || $7 != 143) wrong($5 " of node " $4 " ended by itself, with status " $7)
    }
}

# When an mm-serial that was started then first spoke to the modem: until then it may not have listened.
function spoke_at(node, start,    k) {
    for (k = 1; k <= hosts[node]; ++k) if (host_at[node, k] >= start) return host_at[node, k]
    return start
}
# Whether the node's mm-serial was killed or away about a time at sea.
function was_away(node, at,    k, j, back) {
    for (k = 1; k <= kills[node, "mm-serial"]; ++k) {
        back = kill_at[node, "mm-serial", k]
        for (j = 1; j <= starts[node, "mm-serial"]; ++j)
            if (start_at[node, "mm-serial", j] >= kill_at[node, "mm-serial", k]) { back = spoke_at(node, start_at[node, "mm-serial", j]); break }
        if (at >= kill_at[node, "mm-serial", k] - before_s && at <= back + 1) return 1
    }
    return 0
}
# -1: the destination's modem never said it; 1: it did, while nobody could listen.
function fate(key, node,    k, found) {
    found = -1
    for (k = 1; k <= n_said; ++k) {
        if (said_node[k] != node || index(said_hex[k], bytes[key]) == 0) continue
        found = 0
        if (was_away(node, said_at[k])) return 1
    }
    return found
}
function killed_between(node, from, to,    k) {
    for (k = 1; k <= kills[node, "queue-sched"]; ++k)
        if (kill_at[node, "queue-sched", k] > from - step_s && kill_at[node, "queue-sched", k] < to + step_s) return 1
    return 0
}

END {
    for (i = 1; i <= n_accepted; ++i) {
        key = order[i]
        node = accepted[key]
        if (decoded[node, key]) {
            ++delivered
            if (decoded[node, key] > 1) wrong("message " key " came " decoded[node, key] " times to node " node)
            if (key in reason) ++delivered_and_dropped
        } else if (key in reason)
            ++by_reason[reason[key]]
        else if ((node, key) in replayed)
            ++recovered
        else {
            where = fate(key, node)
            if (where > 0) ++lost_behind
            else if (where == 0) wrong("message " key " was said by the modem of node " node ", whose mm-serial lived, and was not decoded")
            else wrong("message " key " to node " node ": accepted, never said there, and no drop record")
        }
        for (k = 2; k <= drops[key]; ++k) {
            split(key, who, ":")
            if (killed_between(who[1], dropped[key, k - 1], dropped[key, k])) ++drops_again
            else wrong("message " key " has " drops[key] " drop records")
        }
    }
    for (key in decoder) if (!(key in offered)) wrong("node " decoder[key] " decoded " key ", which nobody sent")
    for (node = 1; node <= 4; ++node) {
        total_heard += n_heard[node]; total_live += n_live[node]
        if (n_live[node] != n_afresh[node]) wrong("node " node " has " n_live[node] + 0 " messages where its log holds " n_afresh[node] + 0)
        if (!told[node]) wrong("queue-sched of node " node " told nothing of its queues at the end")
        if (in_vain[node] > 30) wrong("queue-sched of node " node " accepted none of the last " in_vain[node] " messages")
        if (left[node] > 0) wrong("node " node ": " left[node] " messages are still queued after the drain")
        if (last_slot[node] < peace + 120) wrong("node " node ": no slot in the peace at the end")
        if (last_line[node] < peace + 120) wrong("node " node ": no line of the modem in the peace at the end")
    }
    if (delivered == 0) wrong("nothing was delivered")

    printf "offered %d: accepted %d, refused %d, without an answer %d\n", length(offered), n_accepted, answers[1], length(offered) - n_accepted - answers[1]
    printf "accepted %d: delivered %d", n_accepted, delivered
    n = asorti(by_reason, names)
    for (k = 1; k <= n; ++k) printf ", dropped %s %d", names[k], by_reason[names[k]]
    printf ", recovered by mm-serial --replay %d, lost behind the modem of a killed mm-serial %d\n", recovered, lost_behind
    printf "delivered, but dropped as not acknowledged: %d; drops told again after a kill: %d; duplicates suppressed: %d\n",
        delivered_and_dropped, drops_again, total_heard - total_live
    printf "kills %d (tdma-slot %d, queue-sched %d, mm-serial %d, dccl-decode %d), reboots at sea %d and by mm-serial %d, steps %d, stalls with a full FIFO %d, full disks %d\n",
        troubles["kill"], kills_of["tdma-slot"], kills_of["queue-sched"], kills_of["mm-serial"], kills_of["dccl-decode"],
        reboots, starts_of_modems - reboots - 4, troubles["step"], troubles["stall"], troubles["full"]
    if (ended_full) printf "queue-sched ended on a full disk, and was started again: %d\n", ended_full
    printf "violations: %d\n", wrongs
    for (k = 1; k <= wrongs && k <= 50; ++k) print "  " violations[k]
    exit wrongs > 0
}
