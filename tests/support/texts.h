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

/* XML from its first element on: what is opened is closed, in one root. */
static inline void text_is_xml(const char *text)
{
    char open[16][TEXT_TAG];
    int depth = 0, tags = 0;
    for (const char *at = text; (at = strchr(at, '<')) != NULL;) {
        TEST_ASSERT_TRUE_MESSAGE(depth > 0 || tags == 0, "a second root");
        at = text_tag(at, open, 16, &depth);
        ++tags;
    }
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, depth, "something is not closed");
    TEST_ASSERT_TRUE(tags > 0);
}

/* Each row of each table of a page has as many cells as that of its headings. */
static inline void text_tables_are_whole(const char *page)
{
    int columns = 0, cells = 0;
    bool is_head = false;
    for (const char *at = page; (at = strchr(at, '<')) != NULL; ++at) {
        if (strncmp(at, "<thead>", 7) == 0) is_head = true;
        if (strncmp(at, "<tbody>", 7) == 0) is_head = false;
        if (strncmp(at, "<tr>", 4) == 0) cells = 0;
        if (strncmp(at, "<td", 3) == 0 || strncmp(at, "<th ", 4) == 0) ++cells;
        if (strncmp(at, "</tr>", 5) != 0) continue;
        if (is_head) columns = cells;
        TEST_ASSERT_EQUAL_INT_MESSAGE(columns, cells, "a row has not a cell for each heading");
    }
}

/* Row n, from 0, of the body of the table behind a text, as a reader sees it: cells with a blank behind each.
 */
static inline const char *text_row(const char *page, const char *table, int n)
{
    static char text[800];
    const char *at = strstr(page, table);
    size_t used = 0;
    TEST_ASSERT_NOT_NULL_MESSAGE(at, table);
    at = strstr(at, "<tbody>");
    for (int k = 0; k <= n; ++k) {
        at = strstr(at + 1, "<tr>");
        TEST_ASSERT_NOT_NULL_MESSAGE(at, "no such row");
    }
    for (; strncmp(at, "</tr>", 5) != 0 && used + 2 < sizeof text; ++at) {
        if (strncmp(at, "</td>", 5) == 0) text[used++] = ' ';
        if (*at == '<') at = strchr(at, '>');
        if (*at != '>') text[used++] = *at;
    }
    text[used] = '\0';
    return text;
}

static inline int text_rows(const char *page, const char *table)
{
    const char *at = strstr(strstr(page, table), "<tbody>"), *end = strstr(at, "</tbody>");
    int count = 0;
    for (; (at = strstr(at + 1, "<tr>")) != NULL && at < end; ++count)
        ;
    return count;
}

#endif
