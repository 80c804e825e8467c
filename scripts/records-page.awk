# Turns record.proto into the part of seautils-records(5) that tells of each kind, so that neither says what the other
# does not. Fields, enumerators and comments are those of the file. gawk -f records-page.awk record.proto

function escape(text) {
    gsub(/[_*\\]/, "\\\\&", text)
    return text
}

# A sentence from a comment: with a capital, and a stop.
function sentence(text) {
    if (text == "") return ""
    text = toupper(substr(text, 1, 1)) substr(text, 2)
    return escape(text) (text ~ /[.:;]$/ ? "" : ".")
}

function typed(label, type) {
    sub(/^google\.protobuf\.Timestamp$/, "time", type)
    return label == "repeated" ? "list of " type : type
}

function take_comment(text) {
    text = comment
    comment = ""
    return text
}

BEGIN { depth = 0 }

/^ *\/\/ / {
    line = $0
    sub(/^ *\/\/ /, "", line)
    comment = comment (comment == "" ? "" : " ") line
    next
}
/^ *$/ {
    comment = ""
    next
}
/^(syntax|package|import)/ { next }

# The kinds: the key in JSON of each message.
/^  oneof kind/ { in_kinds = 1; next }
in_kinds && /}/ { in_kinds = 0; next }
in_kinds { key[$1] = $2; next }

/^ *message / {
    name[++depth] = $2
    about[depth] = take_comment()
    fields[depth] = enums[depth] = inner[depth] = ""
    next
}

/^ *enum / {
    line = $0
    sub(/^ *enum /, "", line)
    enum = $2
    said = take_comment()
    body = ""
    while (line !~ /}/ && (getline next_line) > 0) line = line "\n" next_line
    sub(/^[^{]*{/, "", line)
    count = split(line, values, /\n/)
    if (count == 1) count = split(line, values, /;/)
    for (k = 1; k <= count; ++k) {
        if (!match(values[k], /[A-Z][A-Z_]*/)) continue
        value = substr(values[k], RSTART, RLENGTH)
        why = values[k] ~ /\/\// ? gensub(/^.*\/\/ */, "", 1, values[k]) : ""
        body = body (body == "" ? "" : "; ") "*" escape(value) "*" (why == "" ? "" : ": " escape(why))
    }
    enums[depth] = enums[depth] "\n_" escape(enum) "_" (said == "" ? "" : " (" escape(said) ")") ": " body ".\n"
    next
}

/^ *(optional|repeated) / {
    field = $3
    said = /\/\// ? gensub(/^.*\/\/ */, "", 1) : ""
    before = take_comment()
    text = before (before != "" && said != "" ? " " : "") said
    fields[depth] = fields[depth] "*" escape(field) "* (" escape(typed($1, $2)) ")\n" \
        (text == "" ? "" : "\t" sentence(text) "\n") "\n"
    next
}

/^ *}/ {
    if (depth == 1) {
        common = enums[1]
        --depth
        next
    }
    title = depth == 2 && (name[2] in key) ? key[name[2]] : name[depth]
    page = "## " toupper(escape(title)) "\n\n" (about[depth] == "" ? "" : sentence(about[depth]) "\n\n") \
        fields[depth] enums[depth] "\n" inner[depth]
    --depth
    if (depth == 1) kinds = kinds page
    else inner[depth] = inner[depth] page
    next
}

END { printf "%s## COMMON\n%s", kinds, common }
