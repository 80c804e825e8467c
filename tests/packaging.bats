#!/usr/bin/env bats
# What is installed and packaged works where it is put.

setup_file() {
    load test_helper
    build=$SEAUTILS_BUILD
    root=$BATS_FILE_TMPDIR/root
    export build root
    [[ -f $build/cmake_install.cmake ]] || skip "the build folder has no install rules"
    DESTDIR=$root cmake --install "$build" --prefix /usr > "$BATS_FILE_TMPDIR/install.log"
}

setup() {
    load test_helper
    bats_require_minimum_version 1.5.0
    usr=$root/usr
    cd "$BATS_TEST_TMPDIR"
}

system_path=/usr/local/bin:/usr/bin:/bin

# Packs a message with the tool of that prefix, unpacks it, and asserts that it is the same.
assert_works() { # PREFIX
    local line='{"dest":5,"action":"HOLD"}'
    run_quiet env "PATH=$1/bin:$system_path" bash -c \
        "dccl-encode -s $1/share/seautils/schemas -m WinchControl <<< '$line' |
         dccl-decode -s $1/share/seautils/schemas -m WinchControl"
    assert_output "$line"
    [[ $(PATH=$1/bin:$system_path command -v dccl-encode) == "$1/bin/dccl-encode" ]]
}

from_cache() { # VARIABLE of the build
    sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"
}

# Debian packages of this build, made once.
make_debs() {
    for program in cpack dpkg-deb dpkg-shlibdeps; do
        command -v $program > /dev/null || skip "$program is not installed"
    done
    debs=$BATS_FILE_TMPDIR/debs
    [[ -d $debs ]] || run -0 cpack -G DEB --config "$build/CPackConfig.cmake" -B "$debs"
    tools_deb=$(echo "$debs"/seautils_*.deb)
    dev_deb=$(echo "$debs"/libseautils-dev_*.deb)
}

@test "packaging: a tool runs from a scratch root" {
    assert_works "$usr"
}

@test "packaging: the demo builds all that is installed" {
    command -v ninja > /dev/null || skip "ninja is not installed"
    [[ $(from_cache CMAKE_GENERATOR) == Ninja ]] || skip "only Ninja says what a target is made of"
    mapfile -t targets < <(sed -n 's/.*--target \([a-z -]*\)$/\1/p' "$BATS_TEST_DIRNAME/../scripts/demo" | tr ' ' '\n')
    ((${#targets[@]} > 0))
    ninja -C "$build" -t commands "${targets[@]}" > made
    for file in "$usr"/bin/* "$usr"/lib/*.a "$usr"/lib/*/*.a "$usr"/share/man/man?/*; do
        [[ ! -e $file ]] || grep -qE "/${file##*/}( |\$)" made || fail "$file is not made by ${targets[*]}"
    done
}

@test "packaging: a tool runs from another prefix" {
    run_quiet cmake --install "$build" --prefix "$BATS_TEST_TMPDIR/opt"
    mv opt moved
    assert_works "$BATS_TEST_TMPDIR/moved"
}

@test "packaging: the table of rates lies beside the schemas" {
    cmp "$BATS_TEST_DIRNAME/../schemas/seautils/micromodem.rates" "$usr/share/seautils/micromodem.rates"
}

@test "packaging: the schemas keep their folders, and nothing else is among them" {
    run find "$usr/share/seautils/schemas" -type f -printf '%P\n'
    assert_line dccl/option_extensions.proto
    assert_line dccl/protobuf/option_extensions.proto
    assert_line seautils/status.proto
    refute_line --regexp '[^o]$'
    run_quiet diff -r --exclude='*.md' --exclude='*.rates' --exclude=CMakeLists.txt "$BATS_TEST_DIRNAME/../schemas" "$usr/share/seautils/schemas"
}

@test "packaging: each tool has its page, and the tour and the formats have theirs" {
    [[ -n $(from_cache SCDOC) && $(from_cache SCDOC) != *NOTFOUND ]] || skip "scdoc is not installed"
    for tool in "$usr"/bin/*; do
        assert_file_exists "$usr/share/man/man1/${tool##*/}.1"
    done
    assert_file_exists "$usr/share/man/man5/seautils-formats.5"
    assert_file_exists "$usr/share/man/man7/seautils.7"
}

@test "packaging: bash completes the options of each tool" {
    for tool in "$usr"/bin/*; do
        tool=${tool##*/}
        run_quiet bash -c "source $usr/share/bash-completion/completions/$tool && complete -p $tool"
        assert_output "complete -F _longopt $tool"
    done
    completion=/usr/share/bash-completion/bash_completion
    [[ -r $completion ]] || skip "bash-completion is not installed"
    run -0 env "PATH=$usr/bin:$system_path" bash -c "
        source $completion
        COMP_WORDS=(dccl-encode --len) COMP_CWORD=1 COMP_LINE='dccl-encode --len' COMP_POINT=17
        _longopt dccl-encode --len dccl-encode
        echo \"\${COMPREPLY[@]}\""
    assert_output --lenient
}

@test "packaging: zsh completes the same tools" {
    read -ra words < "$usr/share/zsh/site-functions/_seautils"
    assert_equal "${words[0]}" '#compdef'
    run_quiet diff <(printf '%s\n' "${words[@]:1}" | sort) <(ls "$usr/bin")
}

@test "packaging: the examples run where they are installed" {
    run -0 env "PATH=$usr/bin:$system_path" "$usr/share/doc/seautils/examples/mission/run"
    assert_line --partial 'all the same within half a resolution'
}

@test "packaging: no file of the installation names the folder that it was built in" {
    [[ -z $SEAUTILS_SANITIZE && $(from_cache CMAKE_BUILD_TYPE) == Release ]] || skip "debugging information names it"
    run grep -rlF "$build" "$root"
    refute_output
}

@test "packaging: the Debian package has a tool that runs, and names what it depends on" {
    make_debs
    dpkg-deb -x "$tools_deb" tools
    assert_works "$BATS_TEST_TMPDIR/tools/usr"
    run_quiet dpkg-deb -f "$tools_deb" Package Version Depends
    assert_line 'Package: seautils'
    assert_line --regexp '^Depends: .*libc6 .*liblua5.3-0'
    refute_output --partial -dev
    run_quiet dpkg-deb -c "$tools_deb"
    assert_line --regexp ' \./usr/share/zsh/vendor-completions/_seautils$'
    refute_line --regexp '\.(a|hpp|cmake|pc)$'
    refute_line --regexp '/man/.*\.[1-9]$' # pages are compressed
}

@test "packaging: the -dev package has headers and libraries, and names their packages" {
    make_debs
    run_quiet dpkg-deb -c "$dev_deb"
    assert_line --regexp ' \./usr/include/seautils/dccl/codec\.hpp$'
    assert_line --regexp '/libseautils_dccl\.a$'
    refute_line --regexp '/(bin|man|schemas)/'
    # Each package that the build looks for is there, by the name that dpkg knows it under.
    depends=$(dpkg-deb -f "$dev_deb" Depends)
    for header in google/protobuf/message.h google/protobuf/compiler/importer.h fmt/format.h simdjson.h \
        pugixml.hpp CLI/CLI.hpp boost/program_options.hpp crypto++/aes.h lua5.3/lua.h; do
        package=$(dpkg -S "/usr/include/$header" | sed 's/:.*//')
        # Boost's headers are in a package of a version, on which the one without depends.
        [[ $header == boost/* ]] && package=libboost-program-options-dev
        assert [ -n "$package" ]
        assert_regex ", $depends," ", ${package//+/\\+},"
    done
}

@test "packaging: a CMake project finds the library, links it and runs" {
    [[ -z $SEAUTILS_SANITIZE ]] || skip "slow with sanitizers"
    run -0 cmake -S "$BATS_TEST_DIRNAME/data/packaging" -B consumer -G "$(from_cache CMAKE_GENERATOR)" \
        -DCMAKE_PREFIX_PATH="$usr" -DCMAKE_CXX_COMPILER="$(from_cache CMAKE_CXX_COMPILER)" \
        -DCMAKE_CXX_FLAGS="$(from_cache CMAKE_CXX_FLAGS)"
    run -0 cmake --build consumer
    # The format's worked example: 170 * 2 + 1 = 0x0155; then 10, 200 and true in 4, 8 and 1 bits.
    run_quiet consumer/consumer
    assert_output 55018a1c
}

@test "packaging: pkg-config says how to compile and link" {
    [[ -z $SEAUTILS_SANITIZE ]] || skip "slow with sanitizers"
    command -v pkg-config > /dev/null || skip "pkg-config is not installed"
    PKG_CONFIG_PATH=$(dirname "$(find "$usr" -name seautils.pc)")
    export PKG_CONFIG_PATH
    run_quiet pkg-config --modversion seautils
    assert_output "$(from_cache CMAKE_PROJECT_VERSION)"
    read -ra flags <<< "$(pkg-config --cflags --libs seautils) $(from_cache CMAKE_CXX_FLAGS)"
    run -0 "$(from_cache CMAKE_CXX_COMPILER)" -std=c++20 -o consumer \
        "$BATS_TEST_DIRNAME/data/packaging/consumer.cpp" "${flags[@]}"
    run_quiet ./consumer
    assert_output 55018a1c
}
