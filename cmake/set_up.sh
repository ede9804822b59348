# What ./run and ./test share: Debian packages, configuring, building. Sourced by bash; `root` is the repository.
# Standard output is kept for results: everything here speaks on standard error.
# shellcheck shell=bash
: "${root:?set it to the repository before sourcing this file}"

say() { printf '%s\n' "$*" >&2; }

# packages_in FILE...: the package names, without comments and blank lines.
packages_in() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$@"; }

is_installed() {
    [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]
}

# install_packages PACKAGE...: as root, or through sudo; exit code 5 with the command to type where neither works.
# The package lists are refreshed only when the first try fails: they are old or missing then.
install_packages() {
    local as_root=()
    if [[ "$(id -u)" != 0 ]]; then
        if ! command -v sudo >/dev/null; then
            say "No root and no sudo here. Type this as root, then start again:"
            say "    apt-get update && apt-get install --no-install-recommends $*"
            exit 5
        fi
        if ! sudo true; then
            say "sudo lets nobody in without a password here. Type this, then start again:"
            say "    sudo apt-get update && sudo apt-get install --no-install-recommends $*"
            exit 5
        fi
        as_root=(sudo)
    fi
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0)
    local install=("${apt[@]}" install --yes --no-install-recommends "$@")
    if "${install[@]}" >&2 2>/dev/null </dev/null; then
        return
    fi
    say "Refreshing the package lists ..."
    if ! { "${apt[@]}" update && "${install[@]}"; } >&2; then
        say "The packages could not be installed. Type this, then start again:"
        say "    ${as_root[*]:+sudo }apt-get update && ${as_root[*]:+sudo }apt-get install --no-install-recommends $*"
        exit 5
    fi
}

# need_packages FILE...: installs those of the lists that are missing; asks for root only then.
need_packages() {
    local packages missing=() package
    mapfile -t packages < <(packages_in "$@")
    if ! command -v dpkg-query >/dev/null; then
        say "No dpkg-query here, so nothing can be checked. On Debian 12 these packages are needed: ${packages[*]}"
        return
    fi
    for package in "${packages[@]}"; do
        is_installed "$package" || missing+=("$package")
    done
    if ((${#missing[@]} > 0)); then
        say "Installing ${#missing[@]} missing Debian packages: ${missing[*]}"
        install_packages "${missing[@]}"
    fi
}

# configure [CMAKE ARGUMENT...]: build/release; silent unless it fails.
configure() {
    local log
    if ! log="$(cd "$root" && cmake --preset release "$@" 2>&1)"; then
        say "$log"
        say "Configuring failed; the words above say where."
        exit 1
    fi
}

# build TARGET: one target, or `all`, in build/release, with progress.
build() {
    if ! (cd "$root" && cmake --build --preset release --target "$1") >&2; then
        say "Building failed; the words above say where."
        exit 1
    fi
}
