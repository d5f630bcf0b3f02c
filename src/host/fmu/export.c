/* An FMU from its parts: description and data of one machine, the sources that all FMUs share, the binary,
 * and the archive. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/fmu/fmu.h"
#include "hci/version.h"
#include "host/base/digest.h"
#include "host/base/memory.h"
#include "host/fmu/controller_code.h"
#include "host/fmu/machine_code.h"
#include "host/fmu/sources.h"
#include "host/fmu/zip.h"

enum { MOST_FILES = 128, PATH_SIZE = 4096 };

typedef struct {
    const hci_fmu_request *request;
    hci_fmu_result *result;
    hci_note *note;
    hci_machine_data joined; /* with the drive */
    hci_fmu_machine_model machine;
    hci_fmu_controller_model controller;
    hci_long_text data;        /* hci_data.c */
    hci_long_text description; /* modelDescription.xml */
    hci_long_text build;       /* buildDescription.xml */
    char token[48];
    hci_zip_entry source[MOST_FILES]; /* by their names */
    size_t sources;
    const char *code[MOST_FILES]; /* those that are compiled */
    size_t codes;
    char *binary;
    size_t binary_bytes;
} export;

/* ---- names ---- */

/* A C identifier of a machine's name: at most 8 characters before it, and `end`, of at most 15, behind. */
static void make_identifier(const char *name, const char *end, char identifier[HCI_MACHINE_NAME + 24])
{
    static const char LETTERS[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
    size_t length = 0;
    if (name[0] == '\0' || strspn(name, "0123456789") > 0) length = (size_t)sprintf(identifier, "machine_");
    for (; *name; ++name)
        identifier[length++] = strchr(LETTERS, *name) ? *name : '_';
    strcpy(identifier + length, end);
}

/* Of everything that is compiled, so that a description cannot be used with another binary. */
static void make_token(export *e)
{
    uint64_t sum[2] = {HCI_DIGEST_START, ~HCI_DIGEST_START};
    for (int k = 0; k < 2; ++k) {
        for (size_t j = 0; j < e->sources; ++j)
            sum[k] = hci_digest_next(sum[k], e->source[j].bytes, e->source[j].size);
        sum[k] = hci_digest_next(sum[k], e->data.text, e->data.size);
    }
    snprintf(e->token, sizeof e->token,
             "{%08" PRIx64 "-%04" PRIx64 "-%04" PRIx64 "-%04" PRIx64 "-%012" PRIx64 "}", sum[0] >> 32,
             sum[0] >> 16 & 0xFFFF, sum[0] & 0xFFFF, sum[1] >> 48, sum[1] & 0xFFFFFFFFFFFF);
}

/* ---- sources ---- */

static bool begins(const char *name, const char *start)
{
    return strncmp(name, start, strlen(start)) == 0;
}

static bool ends(const char *name, const char *end)
{
    const size_t length = strlen(name), more = strlen(end);
    return length >= more && strcmp(name + length - more, end) == 0;
}

static bool is_controller(const export *e)
{
    return e->request->level_count > 0;
}

/* Of two versions and two models an FMU has one. */
static bool is_wanted(const export *e, const char *name)
{
    if (begins(name, "fmu_fmi")) return name[strlen("fmu_fmi")] - '0' == e->request->fmi_version;
    return !begins(name, is_controller(e) ? "fmu_machine" : "fmu_controller");
}

static hci_status add_source(export *e, const char *name, const void *bytes, size_t size)
{
    if (e->sources == MOST_FILES)
        return hci_note_set(e->note, HCI_ERROR_ARGUMENT, "more sources than %d", MOST_FILES);
    e->source[e->sources++] = (hci_zip_entry){name, bytes, size};
    if (ends(name, ".c")) e->code[e->codes++] = name;
    return HCI_OK;
}

static hci_status add_sources(export *e)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < hci_fmu_source_count && !status; ++k) {
        const hci_fmu_source *s = &hci_fmu_sources[k];
        if (is_wanted(e, s->name)) status = add_source(e, s->name, s->bytes, s->size);
    }
    return status;
}

/* ---- texts ---- */

static hci_status make_data(export *e)
{
    hci_long_text_add(&e->data,
                      "/* Written by hci-solve " HCI_VERSION_STRING
                      "; export it again rather than edit it.\n * SPDX-License-Identifier: MIT */\n");
    if (is_controller(e))
        hci_fmu_controller_code(&e->controller, &e->data);
    else
        hci_fmu_machine_code(&e->machine, &e->data);
    if (!e->data.failed) make_token(e);
    hci_long_text_add(&e->data, "\nconst char hci_fmu_token[] = \"%s\";\n", e->token);
    if (e->data.failed) return hci_note_memory(e->note, NULL, "the data of an FMU");
    return add_source(e, "hci_data.c", e->data.text, e->data.size);
}

static void count_variables(export *e, const hci_fmu_description *d)
{
    size_t *const counts[] = {[HCI_FMU_PARAMETER] = &e->result->parameters,
                              [HCI_FMU_INPUT] = &e->result->inputs,
                              [HCI_FMU_OUTPUT] = &e->result->outputs};
    for (size_t k = 0; k < d->count; ++k)
        *counts[d->list[k].causality] += !d->left_out[k];
}

static hci_status make_description(export *e)
{
    hci_fmu_description d = {.identifier = e->result->identifier,
                             .name = e->request->machine->identity.name,
                             .token = e->token,
                             .sources = e->code,
                             .source_count = e->codes};
    if (is_controller(e))
        hci_fmu_controller_describe(&e->controller, &d);
    else
        hci_fmu_machine_describe(&e->machine, &d);
    count_variables(e, &d);
    if (e->request->fmi_version == 2) {
        hci_fmu_describe_2(&d, &e->description);
    } else {
        hci_fmu_describe_3(&d, &e->description);
        hci_fmu_describe_build(&d, &e->build);
    }
    if (e->description.failed || e->build.failed)
        return hci_note_memory(e->note, NULL, "a model description");
    return HCI_OK;
}

/* ---- binary ---- */

/* Temporary files: nobody reads them but the compiler. */
static hci_status write_sources(export *e)
{
    for (size_t k = 0; k < e->sources; ++k) {
        char path[PATH_SIZE];
        snprintf(path, sizeof path, "%s/%s", e->request->work_folder, e->source[k].path);
        FILE *file = fopen(path, "wb");
        const bool is_written =
            file && fwrite(e->source[k].bytes, 1, e->source[k].size, file) == e->source[k].size;
        if (!file || fclose(file) != 0 || !is_written)
            return hci_note_set(e->note, HCI_ERROR_OUTPUT, "%s: cannot be written: %s", path,
                                strerror(errno));
    }
    return HCI_OK;
}

static hci_status read_binary(export *e, const char *library)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s", e->request->work_folder, library);
    FILE *file = fopen(path, "rb");
    long size = -1;
    if (file && fseek(file, 0, SEEK_END) == 0) size = ftell(file);
    if (size > 0) e->binary = hci_memory_new((size_t)size, 1);
    if (e->binary && fseek(file, 0, SEEK_SET) == 0) e->binary_bytes = fread(e->binary, 1, (size_t)size, file);
    if (file) fclose(file);
    if (size > 0 && e->binary_bytes == (size_t)size) return HCI_OK;
    return hci_note_set(e->note, HCI_ERROR_OUTPUT, "%s: the compiler made no library that can be read", path);
}

/* Where a binary of this system belongs; NULL where the standard has no name for it. */
static const char *binary_folder(int fmi_version)
{
#if defined __linux__ && defined __x86_64__
    return fmi_version == 2 ? "binaries/linux64/" : "binaries/x86_64-linux/";
#elif defined __linux__ && defined __i386__
    return fmi_version == 2 ? "binaries/linux32/" : "binaries/x86-linux/";
#elif defined __linux__ && defined __aarch64__
    return fmi_version == 2 ? NULL : "binaries/aarch64-linux/";
#else
    (void)fmi_version;
    return NULL;
#endif
}

static hci_status make_binary(export *e)
{
    char library[HCI_MACHINE_NAME + 32];
    if (!e->request->compile) return HCI_OK;
    if (!binary_folder(e->request->fmi_version))
        return hci_note_set(e->note, HCI_ERROR_ARGUMENT,
                            "FMI %d has no name for a binary of this system; give --sources-only",
                            e->request->fmi_version);
    snprintf(library, sizeof library, "%s.so", e->result->identifier);
    hci_status status = write_sources(e);
    if (!status)
        status = e->request->compile(e->request->compile_context, e->request->work_folder, e->code, e->codes,
                                     library, e->note);
    return status ? status : read_binary(e, library);
}

/* ---- archive ---- */

typedef struct {
    hci_zip_entry entry[MOST_FILES + 4];
    char path[MOST_FILES + 4][128];
    size_t count;
} archive;

static void add_entry(archive *a, const char *folder, const char *name, const void *bytes, size_t size)
{
    snprintf(a->path[a->count], sizeof a->path[0], "%s%s", folder, name);
    a->entry[a->count] = (hci_zip_entry){a->path[a->count], bytes, size};
    ++a->count;
}

static void fill_archive(const export *e, archive *a)
{
    char library[HCI_MACHINE_NAME + 32];
    snprintf(library, sizeof library, "%s.so", e->result->identifier);
    add_entry(a, "", "modelDescription.xml", e->description.text, e->description.size);
    if (e->binary) add_entry(a, binary_folder(e->request->fmi_version), library, e->binary, e->binary_bytes);
    for (size_t k = 0; k < e->sources; ++k)
        add_entry(a, "sources/", e->source[k].path, e->source[k].bytes, e->source[k].size);
    if (e->build.text) add_entry(a, "sources/", "buildDescription.xml", e->build.text, e->build.size);
}

static hci_status write_archive(export *e, const char *path)
{
    hci_output *out = NULL;
    archive *a = hci_memory_new(1, sizeof *a);
    if (!a) return hci_note_memory(e->note, NULL, "an archive");
    fill_archive(e, a);
    for (size_t k = 0; k < a->count; ++k)
        e->result->bytes += a->entry[k].size;
    hci_status status = hci_output_open_file(path, &out, e->note);
    if (!status) status = hci_zip_write(out, a->entry, a->count, e->note);
    hci_memory_free(a);
    if (!status) return hci_output_commit(out, e->note);
    hci_output_discard(out);
    return status;
}

/* ---- all of it ---- */

/* The model, and what is beside it in the sources. */
static hci_status make_model(export *e)
{
    const hci_fmu_request *r = e->request;
    hci_status status = HCI_OK;
    e->joined = *r->machine;
    if (r->drive) status = hci_drive_fit(r->drive, r->machine, &e->joined, e->note);
    if (status) return status;
    if (!is_controller(e)) return hci_fmu_machine_make(r, &e->joined, &e->machine, e->note);
    status = hci_fmu_controller_make(r, &e->joined, &e->controller, e->note);
    if (status) return status;
    const char *const h = e->controller.table_h, *const c = e->controller.table_c;
    status = add_source(e, HCI_FMU_TABLE_H, h, strlen(h));
    return status ? status : add_source(e, HCI_FMU_TABLE_C, c, strlen(c));
}

static hci_status make(export *e, const char *path)
{
    const hci_fmu_request *r = e->request;
    make_identifier(r->machine->identity.name, is_controller(e) ? "_controller" : "", e->result->identifier);
    hci_status status = make_model(e);
    if (!status) status = add_sources(e);
    if (!status) status = make_data(e);
    if (!status) status = make_description(e);
    if (!status) status = make_binary(e);
    if (!status) status = write_archive(e, path);
    e->result->fmi_version = r->fmi_version;
    e->result->effects = r->effects && !is_controller(e) ? r->effects->count : 0;
    e->result->sources = e->sources;
    e->result->binary_bytes = e->binary_bytes;
    if (!is_controller(e)) e->result->remark = e->machine.setup.remark;
    return status;
}

hci_status hci_fmu_export(const char *path, const hci_fmu_request *request, hci_fmu_result *result,
                          hci_note *note)
{
    export *e = hci_memory_new(1, sizeof *e);
    memset(result, 0, sizeof *result);
    if (!e) return hci_note_memory(note, NULL, "an FMU");
    e->request = request;
    e->result = result;
    e->note = note;
    const hci_status status = make(e, path);
    if (is_controller(e))
        hci_fmu_controller_release(&e->controller);
    else
        hci_fmu_machine_release(&e->machine);
    hci_long_text_release(&e->data);
    hci_long_text_release(&e->description);
    hci_long_text_release(&e->build);
    hci_memory_free(e->binary);
    hci_memory_free(e);
    return status;
}
