/* Must pass: text into a buffer, files, an assert. */
#include <assert.h>
#include <stdio.h>

int hci_control_host_good(const char *path, char text[8]);

int hci_control_host_good(const char *path, char text[8])
{
    FILE *file = fopen(path, "w");
    assert(text);
    if (!file) return 0;
    fprintf(file, "%d\n", snprintf(text, 8, "%s", path));
    return fclose(file);
}
