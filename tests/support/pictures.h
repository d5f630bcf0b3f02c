/* A picture read as a reader does: attributes of its elements, corners of its lines, and the scales of its
 * axes by the numbers beside them. Prefix picture_. */
#ifndef PICTURES_H
#define PICTURES_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unity.h"

static const char *picture_text;

/* The n-th place behind a text. */
static inline const char *picture_behind(const char *what, int n)
{
    const char *at = picture_text;
    for (int k = 0; k <= n; ++k) {
        at = strstr(k ? at + 1 : at, what);
        TEST_ASSERT_NOT_NULL_MESSAGE(at, what);
    }
    return at + strlen(what);
}

static inline double picture_attribute(const char *at, const char *name)
{
    char key[24];
    snprintf(key, sizeof key, "%s=\"", name);
    const char *found = strstr(at, key);
    TEST_ASSERT_TRUE(found && found < strchr(at, '>'));
    return strtod(found + strlen(key), NULL);
}

/* value = low + (place − at)·slope, of the numbers beside an axis of the first panel: those at the left end
 * at the box, those below stand in its middle. */
typedef struct {
    double at, low, slope;
} picture_scale;

static inline double picture_number(const char *text)
{
    return strncmp(text, "−", strlen("−")) == 0 ? -strtod(text + strlen("−"), NULL) : strtod(text, NULL);
}

static inline picture_scale picture_scale_of(const char *style, const char *along, double shift)
{
    char key[64];
    double place[2] = {NAN, NAN}, value[2] = {NAN, NAN};
    snprintf(key, sizeof key, "<text class=\"%s\" ", style);
    const char *end = NULL; /* of the panel: where the next one is headed */
    for (const char *at = strstr(picture_text, key); at && !(end && at > end); at = strstr(at + 1, key)) {
        if (!end) end = strstr(at, "<text class=\"head\"");
        const char *text = strchr(at, '>') + 1;
        if (!strchr("0123456789\xE2", *text)) continue;
        const int k = isnan(place[0]) ? 0 : 1;
        place[k] = picture_attribute(at, along) - shift;
        value[k] = picture_number(text);
    }
    TEST_ASSERT_TRUE_MESSAGE(isfinite(place[1]), "fewer than two numbers at an axis");
    return (picture_scale){place[0], value[0], (value[1] - value[0]) / (place[1] - place[0])};
}

static inline double picture_value_at(picture_scale s, double place)
{
    return s.low + (place - s.at) * s.slope;
}

/* Corner `corner` of the n-th line of a style; NULL behind its end. */
static inline bool picture_corner_of(const char *style, int line, int corner, double at[2])
{
    char key[48];
    snprintf(key, sizeof key, "<polyline class=\"%s\" points=\"", style);
    const char *text = picture_behind(key, line);
    for (int k = 0; k <= corner; ++k) {
        char *end;
        if (*text == '"') return false;
        at[0] = strtod(text, &end);
        at[1] = strtod(end + 1, &end);
        text = end + 1;
    }
    return true;
}

#endif
