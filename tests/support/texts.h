/* What stands in a text, and XML read tag by tag. Prefix text_. */
#ifndef TEXTS_H
#define TEXTS_H

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "unity.h"

enum { TEXT_TAG = 16 }; /* bytes of the name of a tag, with its NUL */

static inline void text_has(const char *part, const char *whole)
{
    char message[1400];
    if (strstr(whole, part) != NULL) return;
    snprintf(message, sizeof message, "`%.300s` is not in `%.1000s`", part, whole);
    TEST_FAIL_MESSAGE(message);
}

static inline void text_lacks(const char *part, const char *whole)
{
    TEST_ASSERT_NULL_MESSAGE(strstr(whole, part), part);
}

/* How often, overlapping ones too. */
static inline int text_count(const char *part, const char *whole)
{
    int count = 0;
    for (const char *at = whole; (at = strstr(at, part)) != NULL; ++at)
        ++count;
    return count;
}

/* One tag from `<` on: name, attributes name="value", `>` or `/>`. open: the tags that are open, of which
 * there may be `most`; *depth: how many there are, which goes up, down or stays. Returns what follows. */
static inline const char *text_tag(const char *at, char open[][TEXT_TAG], int most, int *depth)
{
    char tag[TEXT_TAG] = "";
    const bool closing = at[1] == '/';
    at += closing ? 2 : 1;
    const size_t length = strspn(at, "abcdefghijklmnopqrstuvwxyz0123456789");
    TEST_ASSERT_TRUE(length > 0 && length < sizeof tag);
    memcpy(tag, at, length);
    at += length;
    while (*at == ' ') {
        at += 1 + strcspn(at + 1, "=<>\"");
        TEST_ASSERT_EQUAL_STRING_LEN("=\"", at, 2);
        at += 2 + strcspn(at + 2, "<\"");
        TEST_ASSERT_EQUAL_INT('"', *at++);
    }
    if (closing) {
        TEST_ASSERT_TRUE(*depth > 0);
        TEST_ASSERT_EQUAL_STRING(open[--*depth], tag);
    } else if (*at == '/') {
        ++at;
    } else {
        TEST_ASSERT_TRUE(*depth < most);
        memcpy(open[(*depth)++], tag, sizeof tag);
    }
    TEST_ASSERT_EQUAL_INT('>', *at);
    return at + 1;
}

#endif
