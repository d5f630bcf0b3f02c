#include "host/csv/name_words.h"

#include <string.h>

#include "host/csv/channel_name.h"
#include "host/csv/column_name.h"
#include "host/csv/parameter_name.h"
#include "host/csv/table.h"

/* ---- the words ---- */

/* The kinds up to TEMPERATURE are quantities, of which a name says one. */
typedef enum {
    TIME,
    ANGLE,
    POSITION,
    SPEED,
    TORQUE,
    CURRENT,
    VOLTAGE,
    TEMPERATURE,
    QUANTITIES,
    MECHANICAL = QUANTITIES,
    ELECTRICAL,
    TURNING,
    COMPUTED,
    MEASURED,
    ACTUAL,
    ROTOR,
    SHAFT,
    PHASE,
    ALONG_D,
    ALONG_Q,
    RATE,
    SMALL,
    KINDS,
    NUMBER, /* digits alone */
    LETTER, /* of a phase */
    DEVICE, /* letters with digits, as T40B */
    UNKNOWN
} word_kind;

static const struct {
    const char *kind, *words;
} WORDS[KINDS] = {
    [TIME] = {"time", "zeit uhrzeit zeitstempel messzeit time timestamp timestamps temps heure horodatage "
                      "tempo ora tiempo hora"},
    [ANGLE] = {"angle", "winkel drehwinkel rotorwinkel wellenwinkel winkelposition rotorlage lauferlage "
                        "laeuferlage lauferwinkel laeuferwinkel rotorposition lauferposition "
                        "laeuferposition wellenlage motorwinkel motorlage motorposition resolverwinkel "
                        "resolverlage resolverposition geberwinkel geberlage geberposition encoderwinkel "
                        "encoderposition angle ang agl angolo angulo theta phi"},
    [POSITION] = {"angle, of what turns or in a unit of angle",
                  "position pos lage istlage istposition lageistwert positionsistwert posizione posicion"},
    [SPEED] = {"speed", "drehzahl istdrehzahl drehzahlistwert motordrehzahl wellendrehzahl rotordrehzahl "
                        "winkelgeschwindigkeit geschwindigkeit speed "
                        "velocity velo vel spd vitesse regime velocita velocidad giri"},
    [TORQUE] = {"torque",
                "drehmoment moment wellenmoment wellendrehmoment motormoment motordrehmoment istmoment "
                "istdrehmoment momentenistwert "
                "drehmomentistwert drehmomentsensor messwelle torque trq couple coppia par momento"},
    [CURRENT] =
        {"current",
         "strom phasenstrom strangstrom motorstrom iststrom stromistwert current curr courant intensite "
         "corrente corriente intensidad"},
    [VOLTAGE] = {"voltage",
                 "spannung phasenspannung strangspannung klemmenspannung voltage tension tensione voltaje"},
    [TEMPERATURE] = {"temperature", "temperatur temperature temperatura"},
    [MECHANICAL] = {"mechanical",
                    "mech mechanisch mechanischer mechanical mecanique meca mec mecc meccanico meccanica "
                    "mecanico mecanica"},
    [ELECTRICAL] = {"electrical",
                    "el elek elektr elektrisch elektrischer elec electrical electrique elettrico elettrica "
                    "electrico electrica"},
    [TURNING] =
        {"of what turns",
         "angular angulaire angolare rotation rotational rotatif rotative rotazione rotacion rot giro tours"},
    [COMPUTED] =
        {"computed",
         "berechnet berechnetes errechnet geschatzt geschatztes geschaetzt calcule estime calculated "
         "estimated computed calcolata calcolato stimata calculado estimado"},
    [MEASURED] = {"measured",
                  "gemessen gemessenes mess messwert measured meas mesure mesuree misurato misurata medido "
                  "medida sensor aufnehmer messnabe messflansch capteur couplemetre sensore torsiometro "
                  "transducer torquemeter external extern"},
    [ACTUAL] = {"actual", "ist istwert actual act reel attuale feedback fb retour"},
    [ROTOR] = {"rotor or motor", "rotor rotore laufer laeufer motor mot moteur motore magnet aimant magnete "
                                 "encoder drehgeber geber codeur "
                                 "resolver codificador"},
    [SHAFT] = {"shaft", "welle motorwelle shaft arbre albero eje"},
    [PHASE] = {"phase",
               "phase pha fase strang leiter klemme klemmen terminal terminals borne bornes morsetto"},
    [ALONG_D] = {"along d", "d sd feldbildend feldbildender langsstrom laengsstrom"},
    [ALONG_Q] = {"along q", "q sq momentenbildend momentenbildender querstrom"},
    [RATE] = {"rate of sampling", "standardmessrate messrate schnelle langsame default sample rate elapsed "
                                  "ecoule relative relativ absolute absolut"},
    [SMALL] = {"small words",
               "de di del du der des den of the am an im in l la le value wert valeur valore valor"},
};

const char *hci_name_words_known(size_t k, const char **kind)
{
    if (k >= KINDS) return NULL;
    *kind = WORDS[k].kind;
    return WORDS[k].words;
}

/* ---- a name cut into words ---- */

enum { MOST_WORDS = 12, MOST_BYTES = 96 };

typedef struct {
    char text[MOST_BYTES]; /* words one behind the other, each ended by a NUL */
    const char *word[MOST_WORDS];
    word_kind kind[MOST_WORDS];
    size_t count;
} name_words;

/* The letter below an accent of Latin-1, as the second byte in UTF-8: C3 80 to C3 BF; 0: none. */
static char without_accent(unsigned char byte)
{
    static const char LETTERS[] = "aaaaaa\0ceeeeiiii\0nooooo\0ouuuuy\0s";
    const unsigned place = (byte & 0x3FU) % 0x20U;
    return byte == 0x9F ? 's' : LETTERS[place];
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_capital(char c)
{
    return c >= 'A' && c <= 'Z';
}

static bool is_letter(char c)
{
    return is_capital(c) || (c >= 'a' && c <= 'z');
}

/* Whether a word ends between two letters as they are written: PhaseCurrent, IPhase, Strom1. */
static bool is_edge(char before, char c, char next, size_t length)
{
    const bool is_next_small = is_letter(next) && !is_capital(next);
    if (is_capital(c)) return is_letter(before) && (!is_capital(before) || is_next_small);
    return is_digit(c) && !is_digit(before) && length > 3;
}

static bool put(name_words *w, size_t *used, char c)
{
    if (*used + 1 >= MOST_BYTES) return false;
    w->text[(*used)++] = c;
    return true;
}

/* Ends the word that began at `start`, if it has a letter. */
static bool end_word(name_words *w, size_t *start, size_t *used)
{
    if (*used == *start) return true;
    if (w->count == MOST_WORDS || !put(w, used, '\0')) return false;
    w->word[w->count++] = w->text + *start;
    *start = *used;
    return true;
}

/* False: too long, or letters of another script. */
static bool cut(const char *name, size_t length, name_words *w)
{
    size_t used = 0, start = 0;
    bool good = true;
    char before = '\0';
    for (size_t k = 0; k < length && good; ++k) {
        const unsigned char byte = (unsigned char)name[k];
        char c = name[k];
        if (byte == 0xC3 && k + 1 < length) c = without_accent((unsigned char)name[++k]);
        if (c == '\0' || (c == name[k] && byte >= 0x80)) return false;
        const bool is_word = is_letter(c) || is_digit(c);
        if (!is_word ||
            (used > start && is_edge(before, c, k + 1 < length ? name[k + 1] : '\0', used - start)))
            good = end_word(w, &start, &used);
        if (is_word) good = good && put(w, &used, (char)(is_capital(c) ? c - 'A' + 'a' : c));
        if (!is_word && strchr(" _-.:,'/()", c) == NULL) return false;
        if (c == '.' && k + 1 < length && is_letter(name[k + 1]))
            return false; /* of a path, no abbreviation */
        before = c;
    }
    return good && end_word(w, &start, &used) && w->count > 0;
}

static bool is_among(const char *list, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = list; length > 0 && (at = strstr(at, word)) != NULL; at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) return true;
    return false;
}

static const char LETTERS_OF_PHASES[] = "a b c u v w 1 2 3 l1 l2 l3 r s t";
static const char PAIRS[] = "ab bc ca uv vw wu 12 23 31";

static word_kind kind_of(const char *word)
{
    const bool has_digit = word[strcspn(word, "0123456789")] != '\0';
    for (int k = 0; k < KINDS; ++k)
        if (is_among(WORDS[k].words, word)) return (word_kind)k;
    if (is_among(LETTERS_OF_PHASES, word) || is_among(PAIRS, word)) return LETTER;
    if (strspn(word, "0123456789") == strlen(word)) return NUMBER;
    return has_digit ? DEVICE : UNKNOWN;
}

static bool is_axis(word_kind kind)
{
    return kind == LETTER || kind == ALONG_D || kind == ALONG_Q;
}

static bool is_in(const hci_unit *unit, const char *of)
{
    return unit != NULL && unit->dimension == hci_unit_find(of, strlen(of))->dimension;
}

/* Controllers put the type of a variable before its name: fMechAngle, lrTorque. */
static void drop_type(name_words *w)
{
    if (w->count < 2 || !is_among("f lr", w->word[0])) return;
    memmove(w->word, w->word + 1, --w->count * sizeof *w->word);
}

/* "Drehmoment M", "Drehzahl n": the symbol behind the word says the same. */
static void pass_symbols(name_words *w)
{
    for (size_t k = 1; k < w->count; ++k)
        if ((is_among("m md t", w->word[k]) && w->kind[k - 1] == TORQUE) ||
            (is_among("n", w->word[k]) && w->kind[k - 1] == SPEED))
            w->kind[k] = SMALL;
}

/* A letter of a quantity at the beginning, alone or before that of a phase: "M Welle", "n ist", "Iq ist",
 * "U12". */
static void read_letter(name_words *w, const hci_unit *unit)
{
    static const char OTHERS[] = "d q sd sq";
    const char first = w->word[0][0], *rest = w->word[0] + 1;
    const bool is_known = w->kind[0] != LETTER && w->kind[0] != UNKNOWN && w->kind[0] != DEVICE;
    if (is_among("md mw", w->word[0]) && is_in(unit, "N*m")) w->kind[0] = TORQUE;
    if (is_known || (strchr("iuv", first) == NULL && *rest != '\0') || is_among(PAIRS, w->word[0])) return;
    const bool is_fused =
        is_among(LETTERS_OF_PHASES, rest) || is_among(PAIRS, rest) || is_among(OTHERS, rest);
    if (*rest != '\0' && (!is_fused || w->count == MOST_WORDS)) return;
    if (*rest == '\0' && w->count < 2) return;
    if (*rest != '\0') {
        memmove(w->word + 1, w->word, w->count * sizeof *w->word);
        memmove(w->kind + 1, w->kind, w->count++ * sizeof *w->kind);
        w->word[1] = rest;
        w->kind[1] = kind_of(rest);
    }
    if (first == 'i') w->kind[0] = CURRENT;
    if ((first == 'u' || first == 'v') && is_axis(w->kind[1])) w->kind[0] = VOLTAGE;
    if (first == 'n' && is_in(unit, "rpm")) w->kind[0] = SPEED;
    if (first == 'm' && is_in(unit, "N*m")) w->kind[0] = TORQUE;
}

static bool says_quantity(const name_words *w)
{
    for (size_t k = 0; k < w->count; ++k)
        if (w->kind[k] < QUANTITIES) return true;
    return false;
}

/* "Phase A (A)": of a phase whose letter is named the unit says the quantity. */
static void read_phase(name_words *w, const hci_unit *unit)
{
    const bool is_current = is_in(unit, "A"), is_voltage = is_in(unit, "V");
    bool is_named = false;
    for (size_t k = 0; k < w->count; ++k)
        is_named = is_named || w->kind[k] == LETTER;
    if (says_quantity(w) || !is_named || !(is_current || is_voltage)) return;
    for (size_t k = 0; k < w->count; ++k)
        if (w->kind[k] == PHASE) w->kind[k] = is_current ? CURRENT : VOLTAGE;
}

/* ---- what the words say together ---- */

#define SAID(column, unit, meaning)                                                                          \
    {                                                                                                        \
        "", column, unit, "words", meaning, NULL                                                             \
    }

static const hci_alias
    OF_TIME = SAID("time_s", "s", "the time"),
    OF_ANGLE[] = {SAID("theta_m_rad", "rad", "the mechanical angle"),
                  SAID("theta_e_rad", "rad", "the electrical angle"), SAID(NULL, NULL, NULL)},
    OF_SPEED[] = {SAID("speed_rad_per_s", "rpm", "the mechanical speed"),
                  SAID("speed_e_rad_per_s", "rpm", "the electrical speed, divided by the pole pairs")},
    OF_TORQUE[] = {SAID("torque_Nm", "N*m", "the torque"),
                   SAID("torque_computed_Nm", "N*m",
                        "a torque that the drive has computed from its current, not measured")},
    OF_CURRENT[] = {SAID("ia_A", "A", "the current of phase a"), SAID("ib_A", "A", "the current of phase b"),
                    SAID("ic_A", "A", "the current of phase c"), SAID("id_A", "A", "i_d"),
                    SAID("iq_A", "A", "i_q")},
    OF_VOLTAGE[] = {SAID("va_V", "V", "the voltage of phase a"), SAID("vb_V", "V", "the voltage of phase b"),
                    SAID("vc_V", "V", "the voltage of phase c"), SAID("vd_V", "V", "v_d"),
                    SAID("vq_V", "V", "v_q")},
    OF_LINE[] = {SAID("vab_V", "V", "the voltage from a to b"), SAID("vbc_V", "V", "the voltage from b to c"),
                 SAID("vca_V", "V", "the voltage from c to a")},
    OF_TEMPERATURE = SAID("temperature_C", "degC", "the temperature of the magnets");

static size_t count_of(const name_words *w, word_kind kind)
{
    size_t count = 0;
    for (size_t k = 0; k < w->count; ++k)
        count += w->kind[k] == kind;
    return count;
}

static bool has(const name_words *w, word_kind kind)
{
    return count_of(w, kind) > 0;
}

/* The place of a word in a list, three by three; −1: it is not there. */
static int place_in(const char *list, const char *word)
{
    int place = 0;
    for (const char *at = list; *at != '\0'; at += strcspn(at, " "), at += *at == ' ', ++place) {
        const size_t length = strcspn(at, " ");
        if (strlen(word) == length && memcmp(at, word, length) == 0) return place % 3;
    }
    return -1;
}

/* The phase that one word or none names: 0 to 2; −1: none, or several. */
static int letter_of(const name_words *w, const char *list)
{
    int found = -1;
    for (size_t k = 0; k < w->count; ++k) {
        if (w->kind[k] != LETTER) continue;
        const int place = place_in(list, w->word[k]);
        if (place < 0 || found >= 0) return -1;
        found = place;
    }
    return found;
}

/* From one phase to the next: "UV", or "U-V" as two words that follow each other. */
static int pair_of(const name_words *w)
{
    char both[3] = "";
    if (count_of(w, LETTER) != 2) return letter_of(w, PAIRS);
    for (size_t k = 0; k + 1 < w->count; ++k)
        if (w->kind[k] == LETTER && w->kind[k + 1] == LETTER && w->word[k][1] == '\0' &&
            w->word[k + 1][1] == '\0') {
            both[0] = w->word[k][0];
            both[1] = w->word[k + 1][0];
        }
    return place_in(PAIRS, both);
}

/* d, q or a phase, as a place in the five of a quantity; −1: none of them. */
static int axis_of(const name_words *w)
{
    const size_t d = count_of(w, ALONG_D), q = count_of(w, ALONG_Q);
    if (d + q == 0) return letter_of(w, LETTERS_OF_PHASES);
    return d > 0 && q > 0 ? -1 : has(w, LETTER) ? -1 : d > 0 ? 3 : 4;
}

static const hci_alias *current_of(const name_words *w)
{
    const int axis = axis_of(w);
    return axis < 0 ? NULL : &OF_CURRENT[axis];
}

static const hci_alias *voltage_of(const name_words *w)
{
    const int axis = axis_of(w), pair = pair_of(w);
    return axis >= 0 ? &OF_VOLTAGE[axis] : pair >= 0 ? &OF_LINE[pair] : NULL;
}

/* Turns of a position are counted on the shaft. */
static bool is_turn(const hci_unit *unit)
{
    return is_in(unit, "rad") && hci_unit_equal(unit, hci_unit_find("turn", 4));
}

/* By its name, and by its unit where that says it (EDeg). */
static const hci_alias *angle_by(bool is_mechanical, bool is_electrical, const hci_unit *unit)
{
    const hci_unit_turn turn = hci_unit_turn_of(unit);
    is_mechanical = is_mechanical || turn == HCI_UNIT_TURN_MECHANICAL;
    is_electrical = is_electrical || turn == HCI_UNIT_TURN_ELECTRICAL;
    return is_mechanical != is_electrical ? &OF_ANGLE[is_electrical] : &OF_ANGLE[2];
}

/* Where is not how far it has turned, as long as nothing says that it turns. */
static const hci_alias *angle_of(const name_words *w, const hci_unit *unit)
{
    const bool turns = has(w, TURNING) || has(w, ROTOR) || has(w, SHAFT) || is_in(unit, "rad");
    if ((has(w, POSITION) && !has(w, ANGLE) && !turns) || has(w, PHASE)) return NULL;
    if (has(w, POSITION) && is_turn(unit)) return &OF_ANGLE[has(w, ELECTRICAL)];
    return angle_by(has(w, MECHANICAL), has(w, ELECTRICAL), unit);
}

/* What a drive calls the actual torque is its current in other words, unless a sensor or the shaft is named.
 */
static const hci_alias *torque_of(const name_words *w)
{
    static const char COMPUTED_WORDS[] = "istmoment istdrehmoment momentenistwert drehmomentistwert";
    bool is_computed = has(w, COMPUTED) || has(w, ACTUAL);
    for (size_t k = 0; k < w->count; ++k)
        is_computed = is_computed || is_among(COMPUTED_WORDS, w->word[k]);
    return &OF_TORQUE[is_computed && !has(w, MEASURED) && !has(w, SHAFT)];
}

static const hci_alias *quantity_of(const name_words *w, const hci_unit *unit)
{
    const bool is_plain = !has(w, ALONG_D) && !has(w, ALONG_Q) && !has(w, LETTER);
    if (has(w, CURRENT)) return current_of(w);
    if (has(w, VOLTAGE)) return voltage_of(w);
    if (!is_plain) return NULL;
    if (has(w, TIME)) return &OF_TIME;
    if (has(w, ANGLE) || has(w, POSITION)) return angle_of(w, unit);
    if (has(w, SPEED)) return &OF_SPEED[has(w, ELECTRICAL)];
    if (has(w, TORQUE)) return torque_of(w);
    return has(w, TEMPERATURE) && has(w, ROTOR) ? &OF_TEMPERATURE : NULL;
}

/* A name of a type as T40B; T2 would be the second of several. */
static bool is_type(const char *word)
{
    return strlen(word) > 2;
}

/* One quantity, which several words may say ("Drehmoment (Messwelle)"; where it stands is an angle, too), and
 * no word that could turn it into another: numbers and rates stand with a time alone, the name of a device
 * before all others or with a torque, "estimated" with a torque alone. */
static bool is_sound(const name_words *w)
{
    size_t quantities = 0;
    for (int k = 0; k < QUANTITIES; ++k)
        quantities += has(w, (word_kind)k) && !(k == POSITION && has(w, ANGLE));
    for (size_t k = 0; k < w->count; ++k) {
        const word_kind kind = w->kind[k];
        if (kind == UNKNOWN || (kind == DEVICE && k > 0 && !(has(w, TORQUE) && is_type(w->word[k]))))
            return false;
        if ((kind == NUMBER || kind == RATE) && !has(w, TIME)) return false;
        if (kind == COMPUTED && !has(w, TORQUE)) return false;
    }
    return quantities == 1;
}

/* Short words that variables of programs have, in units of their own. */
static bool is_short(const name_words *w)
{
    for (size_t k = 0; k < w->count; ++k)
        if (is_among("vel velo spd", w->word[k])) return true;
    return false;
}

/* ---- */

static bool is_fitting(const hci_alias *said, const hci_unit *unit)
{
    return unit == NULL || is_in(unit, said->unit != NULL ? said->unit : "rad");
}

/* What stands behind the last slash of a path. */
static const char *last_part(const char *name, size_t *length)
{
    const char *from = name;
    for (size_t k = 0; k + 1 < *length; ++k)
        if (name[k] == '/' && name[k + 1] != ' ') from = name + k + 1;
    *length -= (size_t)(from - name);
    return from;
}

/* The last part of a path is read as the name of another tool, too. */
static const hci_alias *alias_of(const char *name, size_t length)
{
    for (size_t k = 0; k < hci_alias_count; ++k)
        if (hci_aliases[k].column != NULL && hci_aliases[k].unit != NULL && hci_aliases[k].beside == NULL &&
            hci_alias_is_name(&hci_aliases[k], name, length))
            return &hci_aliases[k];
    return NULL;
}

static const hci_alias *say(const char *name, size_t length, const hci_unit *unit)
{
    name_words w = {.count = 0};
    const char *part = last_part(name, &length);
    const hci_alias *other = part != name ? alias_of(part, length) : NULL;
    if (part != name && hci_channel_is_wanted(name, (size_t)(part - name))) return NULL;
    if (other != NULL) return other;
    if (*part == '-' || !cut(part, length, &w)) return NULL;
    drop_type(&w);
    for (size_t k = 0; k < w.count; ++k)
        w.kind[k] = kind_of(w.word[k]);
    for (size_t k = 0; k < w.count; ++k) /* "Zeit 1" */
        if (w.kind[k] == LETTER && has(&w, TIME)) w.kind[k] = NUMBER;
    pass_symbols(&w);
    read_letter(&w, unit);
    read_phase(&w, unit);
    if (!is_sound(&w) || (unit == NULL && is_short(&w))) return NULL;
    const hci_alias *said = quantity_of(&w, unit);
    return said != NULL && is_fitting(said, unit) ? said : NULL;
}

/* "Strom_A": likely to be the unit. */
static bool ends_in_unit(const char *name)
{
    const size_t length = strlen(name);
    if (length < 2 || strchr("AV", name[length - 1]) == NULL || strchr(" _", name[length - 2]) == NULL)
        return false;
    for (const char *at = name; *at != '\0'; ++at) /* but of phases that are named */
        if (strncmp(at, "hase", 4) == 0 || strncmp(at, "HASE", 4) == 0 || strncmp(at, "ase ", 4) == 0)
            return false;
    return true;
}

/* The words of a name alone, whatever is between. False: letters of another script. */
static bool cut_plain(const char *name, name_words *w)
{
    char plain[MOST_BYTES];
    size_t used = 0;
    for (; name[used] != '\0' && used + 1 < sizeof plain; ++used)
        plain[used] = is_letter(name[used]) || is_digit(name[used]) || (name[used] & 0x80) ? name[used] : ' ';
    plain[used] = '\0';
    if (!cut(plain, used, w)) return false;
    for (size_t k = 0; k < w->count; ++k)
        w->kind[k] = kind_of(w->word[k]);
    return true;
}

/* Whether a name ends with a unit of this quantity, behind one of some signs. */
static bool ends_in(const char *name, const char *signs, const char *of)
{
    for (size_t end = 1; name[0] != '\0' && name[end] != '\0'; ++end)
        if (strchr(signs, name[end]) && is_in(hci_column_unit_of_tail(name + end), of)) return true;
    return false;
}

/* "iq", "i_q": a current that a name says by its letter. */
static bool has_current_letter(const name_words *w)
{
    static const char AXES[] = "d q sd sq";
    for (size_t k = 0; k < w->count; ++k) {
        if (w->word[k][0] != 'i') continue;
        const char *rest = w->word[k] + 1;
        if (*rest == '\0' && k + 1 < w->count && is_among(AXES, w->word[k + 1])) return true;
        if (is_among(AXES, rest)) return true;
    }
    return false;
}

/* What a supply or a battery has is none of the motor. */
static bool is_of_supply(const name_words *w)
{
    static const char SUPPLY[] = "bus dc supply battery batt bat dclink ibus";
    for (size_t k = 0; k < w->count; ++k)
        if (is_among(SUPPLY, w->word[k])) return true;
    return false;
}

static const struct {
    const char *unit;
    word_kind kind;
} LIKE[] = {[HCI_LIKE_TORQUE] = {"N*m", TORQUE},
            [HCI_LIKE_CURRENT] = {"A", CURRENT},
            [HCI_LIKE_SPEED] = {"rpm", SPEED},
            [HCI_LIKE_POSITION] = {"rad", POSITION}};

/* Whether a unit in brackets, or in a row of units, says another of these quantities, whatever the words do:
 * `TorqueCurrent [A]` is a current. */
static bool is_other(hci_name_like what, const char *name, const hci_unit *of_row)
{
    for (int k = 0; k < (int)(sizeof LIKE / sizeof *LIKE); ++k)
        if (k != (int)what && (is_in(of_row, LIKE[k].unit) || ends_in(name, "([", LIKE[k].unit))) return true;
    return false;
}

bool hci_name_words_like(hci_name_like what, const char *name, const hci_unit *of_row)
{
    name_words w = {.count = 0};
    const bool is_like = is_in(of_row, LIKE[what].unit) || ends_in(name, "_([/, ", LIKE[what].unit);
    const char *dot = strrchr(name, '.'), *last = dot != NULL ? dot + 1 : name; /* of a path */
    if (hci_channel_is_wanted(last, strlen(last)) || is_other(what, name, of_row)) return false;
    if (!cut_plain(name, &w)) return is_like;
    if (what == HCI_LIKE_CURRENT && is_of_supply(&w)) return false;
    return is_like || has(&w, LIKE[what].kind) || (what == HCI_LIKE_CURRENT && has_current_letter(&w));
}

bool hci_name_words_along_d(const char *name)
{
    name_words w = {.count = 0};
    if (!cut_plain(name, &w)) return false;
    for (size_t k = 0; k < w.count; ++k)
        if (is_among("d id isd sd", w.word[k])) return true;
    return false;
}

bool hci_name_words_are_clear(const hci_alias *said)
{
    return said->name[0] == '\0' && said != &OF_TORQUE[1];
}

static const hci_alias *say_with_unit(const char *name, const hci_unit *of_row, const hci_unit **unit)
{
    const size_t length = strlen(name);
    *unit = NULL;
    if (length > MOST_BYTES || name[0] == '\0') return NULL;
    for (size_t end = 1; end < length; ++end) {
        if (strchr("_([/, ", name[end]) == NULL) continue;
        const hci_unit *of_tail = hci_column_unit_of_tail(name + end);
        const hci_alias *said = of_tail != NULL ? say(name, end, of_tail) : NULL;
        if (said == NULL) continue;
        *unit = of_tail;
        return said;
    }
    return ends_in_unit(name) ? NULL : say(name, length, of_row);
}

/* A name of an angle of either kind whose unit says which; NULL: it is none such. */
static const hci_alias *say_by_unit(const char *name, const hci_unit *of_row, const hci_unit **unit)
{
    for (size_t k = 0; k < hci_alias_count; ++k) {
        if (hci_aliases[k].column != NULL || !hci_column_split_alias(name, &hci_aliases[k], unit)) continue;
        const hci_unit *said = *unit != NULL ? *unit : of_row;
        if (hci_unit_turn_of(said) != HCI_UNIT_TURN_UNSAID) return angle_by(false, false, said);
    }
    return NULL;
}

const hci_alias *hci_name_words(const char *name, const hci_unit *of_row, const hci_unit **unit)
{
    char channel[HCI_CHANNEL_SIZE];
    bool is_of_place;
    const hci_alias *said = hci_parameter_name(name, unit);
    if (said == NULL) said = say_by_unit(name, of_row, unit);
    if (said == NULL) said = say_with_unit(name, of_row, unit);
    if (said != NULL || !hci_channel_name(name, channel, &is_of_place)) return said;
    said = say_with_unit(channel, of_row, unit);
    return is_of_place && *unit == NULL && of_row == NULL ? NULL : said;
}

bool hci_column_has_known_name(const char *name)
{
    const hci_unit *unit;
    char plain[HCI_CHANNEL_SIZE];
    double factor;
    const bool has_amplitude = hci_column_without_amplitude(name, plain, &factor);
    for (size_t k = 0; k < hci_alias_count; k++) {
        if (hci_aliases[k].column == NULL || strcmp(hci_aliases[k].name, "theta") == 0) continue;
        const hci_wanted_column want = hci_wanted_column_of(hci_aliases[k].column);
        const char *shown = has_amplitude && hci_column_is_along_axis(&want) ? plain : name;
        if (hci_column_split_alias(shown, &hci_aliases[k], &unit) || hci_column_split(shown, &want, &unit))
            return true;
    }
    return false;
}

bool hci_column_is_known(const char *name)
{
    const hci_unit *unit;
    return hci_column_has_known_name(name) || hci_name_words(name, NULL, &unit) != NULL;
}
