/* JSON text by cJSON, which no other file includes. */
#include "host/base/json.h"

#include <assert.h>
#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "host/base/memory.h"

/* cJSON has no other way to tell that memory is out. */
static void use_own_memory(void)
{
    cJSON_Hooks own = {hci_memory_malloc, hci_memory_free};
    cJSON_InitHooks(&own);
}

void hci_json_begin(hci_json *j)
{
    use_own_memory();
    j->open[0] = cJSON_CreateObject();
    j->depth = 1;
    j->failed = !j->open[0];
}

static cJSON *parsed(const char *text)
{
    use_own_memory();
    return cJSON_Parse(text);
}

void hci_json_continue(hci_json *j, const char *text)
{
    j->open[0] = parsed(text);
    j->depth = 1;
    j->failed = !cJSON_IsObject(j->open[0]);
}

/* Adds an item, which may be NULL for lack of memory. */
static bool add(hci_json *j, const char *name, cJSON *item)
{
    cJSON *into = j->open[j->depth - 1];
    if (item && (name ? cJSON_AddItemToObject(into, name, item) : cJSON_AddItemToArray(into, item)))
        return true;
    cJSON_Delete(item);
    j->failed = true;
    return false;
}

static void open_item(hci_json *j, const char *name, cJSON *item)
{
    assert(j->depth < HCI_JSON_MOST_OPEN);
    if (add(j, name, item)) j->open[j->depth++] = item;
}

void hci_json_object(hci_json *j, const char *name)
{
    if (!j->failed) open_item(j, name, cJSON_CreateObject());
}

void hci_json_array(hci_json *j, const char *name)
{
    if (!j->failed) open_item(j, name, cJSON_CreateArray());
}

void hci_json_close(hci_json *j)
{
    if (j->failed) return;
    assert(j->depth > 1);
    --j->depth;
}

void hci_json_number(hci_json *j, const char *name, double value)
{
    if (!j->failed) add(j, name, isfinite(value) ? cJSON_CreateNumber(value) : cJSON_CreateNull());
}

void hci_json_bool(hci_json *j, const char *name, bool value)
{
    if (!j->failed) add(j, name, cJSON_CreateBool(value));
}

void hci_json_text(hci_json *j, const char *name, const char *value)
{
    if (!j->failed) add(j, name, cJSON_CreateString(value));
}

char *hci_json_end(hci_json *j)
{
    assert(j->failed || j->depth == 1);
    char *text = j->failed ? NULL : cJSON_Print(j->open[0]);
    cJSON_Delete(j->open[0]);
    return text;
}

void hci_json_free(char *text)
{
    cJSON_free(text);
}

/* In the object `object` of a text, or with NULL in the outermost one; NULL where there is none. */
static const cJSON *find(const cJSON *all, const char *object, const char *name)
{
    const cJSON *in = all && object ? cJSON_GetObjectItemCaseSensitive(all, object) : all;
    return in ? cJSON_GetObjectItemCaseSensitive(in, name) : NULL;
}

bool hci_json_find_bool(const char *text, const char *object, const char *name, bool *value)
{
    cJSON *all = parsed(text);
    const cJSON *item = find(all, object, name);
    const bool found = cJSON_IsBool(item);
    if (found) *value = cJSON_IsTrue(item);
    cJSON_Delete(all);
    return found;
}

bool hci_json_find_number(const char *text, const char *object, const char *name, double *value)
{
    cJSON *all = parsed(text);
    const cJSON *item = find(all, object, name);
    const bool found = cJSON_IsNumber(item);
    if (found) *value = item->valuedouble;
    cJSON_Delete(all);
    return found;
}

bool hci_json_find_text(const char *text, const char *object, const char *name, char *value, size_t size)
{
    cJSON *all = parsed(text);
    const cJSON *item = find(all, object, name);
    const bool found = cJSON_IsString(item) && strlen(item->valuestring) < size;
    if (found) strcpy(value, item->valuestring);
    cJSON_Delete(all);
    return found;
}

bool hci_json_each_text(const char *text, const char *object,
                        bool (*take)(void *context, const char *name, const char *value), void *context)
{
    cJSON *all = parsed(text);
    const cJSON *in = find(all, NULL, object), *item;
    const bool found = cJSON_IsObject(in);
    for (item = found ? in->child : NULL; item; item = item->next)
        if (cJSON_IsString(item) && !take(context, item->string, item->valuestring)) break;
    cJSON_Delete(all);
    return found;
}
