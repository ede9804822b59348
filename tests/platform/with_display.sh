# Runs a command where there is a display: on the one at hand, else on an invisible one. Exits 77 when there is neither.
if [ -n "$DISPLAY" ]; then exec "$@"; fi
for tool in xvfb-run xauth; do
    if ! command -v "$tool" >/dev/null; then
        echo "skipped: no DISPLAY, and $tool is not there; install the Debian packages xvfb and xauth"
        exit 77
    fi
done
exec xvfb-run -a "$@"
