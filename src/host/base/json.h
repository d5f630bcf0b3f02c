/* JSON, written from top to bottom: objects and arrays are opened, filled and closed. A call after a failure
 * does nothing, so that only the end has to be looked at. */
#ifndef HCI_SRC_HOST_BASE_JSON_H
#define HCI_SRC_HOST_BASE_JSON_H

#include <stdbool.h>
#include <stddef.h>

enum { HCI_JSON_MOST_OPEN = 8 }; /* objects and arrays within one another */

typedef struct {
    void *open[HCI_JSON_MOST_OPEN]; /* the whole first */
    size_t depth;
    bool failed; /* memory is out */
} hci_json;

/* Opens the object that all is in. To be ended with hci_json_end. */
void hci_json_begin(hci_json *json);

/* Opens the object of a text that was written before, to add to it. To be ended with hci_json_end. */
void hci_json_continue(hci_json *json, const char *text);

/* name: of a member of the object that is open; NULL for an item of the array that is open. What is opened is
 * to be closed. */
void hci_json_object(hci_json *json, const char *name);
void hci_json_array(hci_json *json, const char *name);
void hci_json_close(hci_json *json);

/* A value that is not finite is null: JSON has no other word for a number that does not exist. */
void hci_json_number(hci_json *json, const char *name, double value);
void hci_json_bool(hci_json *json, const char *name, bool value);
void hci_json_text(hci_json *json, const char *name, const char *value);

/* All of it as a text, to be freed with hci_json_free; NULL when memory is out. */
char *hci_json_end(hci_json *json);
void hci_json_free(char *text);

/* A truth value in the object `object` of a text, or with NULL in the outermost one. False where the text is
 * no JSON or has none of that name; *value is then left. */
bool hci_json_find_bool(const char *text, const char *object, const char *name, bool *value);

/* Likewise a number. */
bool hci_json_find_number(const char *text, const char *object, const char *name, double *value);

/* Likewise a text of less than `size` bytes. */
bool hci_json_find_text(const char *text, const char *object, const char *name, char *value, size_t size);

/* Calls `take` with each text in the object `object` of a text, in their order, until it returns false. False
 * where the text is no JSON or has no such object. */
bool hci_json_each_text(const char *text, const char *object,
                        bool (*take)(void *context, const char *name, const char *value), void *context);

#endif
