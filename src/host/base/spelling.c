#include "hci/host/base/spelling.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum { MOST_LETTERS = 24, FAR = 1000 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* Letters to put in, take out, change or swap with their neighbour, to make one word of another. */
static int distance(const char *a, const char *b)
{
    int d[MOST_LETTERS + 1][MOST_LETTERS + 1];
    const int m = (int)strlen(a), n = (int)strlen(b);
    if (m > MOST_LETTERS || n > MOST_LETTERS) return FAR;
    for (int i = 0; i <= m; ++i)
        d[i][0] = i;
    for (int j = 0; j <= n; ++j)
        d[0][j] = j;
    for (int i = 1; i <= m; ++i)
        for (int j = 1; j <= n; ++j) {
            d[i][j] = least(least(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[m][n];
}

/* Twice the mistakes in a name, or one more than twice those in its first part, as limit of limit-current. */
static int mistakes(const char *word, const char *name)
{
    char first[MOST_LETTERS + 1];
    const size_t length = strcspn(name, "-");
    const int whole = 2 * distance(word, name);
    if (name[length] == '\0' || length > MOST_LETTERS) return whole;
    memcpy(first, name, length);
    first[length] = '\0';
    return least(whole, 2 * distance(word, first) + 1);
}

const char *hci_nearest(const char *word, const char *const *names)
{
    const char *nearest = NULL;
    int best = 2 * (1 + (int)strlen(word) / 3); /* one mistake in three letters */
    if (strlen(word) < 2) return NULL;
    for (; *names; ++names) {
        const bool begins = strlen(word) > 2 && strncmp(*names, word, strlen(word)) == 0;
        const int far = begins ? 0 : mistakes(word, *names);
        if (far >= best) continue;
        best = far;
        nearest = *names;
    }
    return nearest;
}
