# The recordings of docs/tutorials/mn4004.md, where they are, in place of the stand-ins that the page makes. The figures on the page are theirs.
# Called in a scratch folder.
real=../shared/measured/laas_mn4004
if [ -d "$real" ]; then
    cp -R "$real" recordings && chmod -R u+w recordings || exit 1
    echo 'python3 the recordings themselves are here' >>../not_run
    exit 0
fi
echo 'the page shows figures of recordings that are not here; these are stand-ins' >../no_figures
command -v python3 >/dev/null && exit 0
echo 'python3 is not installed' >>../not_run
echo recordings
exit 77
