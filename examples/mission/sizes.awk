# sizes.awk - the table of sizes
#
# od -An -v -tu1 -w1 got.bin | awk -v types=grouped.ndjson -v hex=grouped.hex -v csv_bytes=N -f sizes.awk
#
# The input is a delimited stream, one byte (in decimal) a line; message k of it, line k of `types`
# and line k of `hex` are the same message.

function one_message(bytes,    json, type, encoded) {
    if ((getline json < types) <= 0 || (getline encoded < hex) <= 0) return
    match(json, /"@type" *: *"[^"]*"/)
    type = substr(json, RSTART, RLENGTH)
    gsub(/.*: *"|"$/, "", type)
    if (!(type in count)) order[++kinds] = type
    count[type]++
    ndjson_bytes[type] += length(json) + 1
    protobuf_bytes[type] += bytes
    dccl_bytes[type] += length(encoded) / 2
}

function hours(bytes,    s) {
    s = bytes * 8 / 80
    return sprintf("%d h %02d min", s / 3600, s % 3600 / 60)
}

function row(name, n, j, p, d) {
    printf "%-18s %8d %9d %9d %9d %9.1f  %13s\n", name, n, j, p, d, d / n, hours(d)
    all_n += n; all_j += j; all_p += p; all_d += d
}

skip > 0 { skip--; next }

{
    size += $1 % 128 * 128 ^ shift++
    if ($1 >= 128) next
    one_message(size)
    skip = size
    size = shift = 0
}

END {
    if (kinds == 0) exit 1
    print "bytes              messages    NDJSON  protobuf      DCCL a message  at 80 bit/s"
    for (i = 1; i <= kinds; i++) {
        type = order[i]
        row(type, count[type], ndjson_bytes[type], protobuf_bytes[type], dccl_bytes[type])
    }
    j = all_j; p = all_p; d = all_d; n = all_n
    if (kinds > 1) row("together", n, j, p, d)
    printf "The recording itself, all its rows and columns: %d bytes of CSV, %s at 80 bit/s.\n", \
        csv_bytes, hours(csv_bytes)
    printf "As NDJSON the messages would take %s, as protobuf %s.\n", hours(j), hours(p)
}
