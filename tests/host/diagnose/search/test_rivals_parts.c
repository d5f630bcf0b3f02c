/* Which rivals are looked at, and by how much they have to be better, from scores by hand. */
#include "host/diagnose/search/rivals.c"

#include "unity.h"

static hci_candidate list[4], others[4];
static hci_fitted_model model, rival;
static hci_search search;
static rivalry r;
static hci_attribution a;
static bool in[4];

static const hci_effect_type *type(const char *name)
{
    return hci_effect_type_find(name);
}

static size_t index_of(const char *name)
{
    return type_index(type(name));
}

static void put(hci_candidate *where, hci_candidates *of, const char *name, size_t terms, double order)
{
    where[of->count] = (hci_candidate){.type = type(name), .count = terms, .in = true};
    for (size_t k = 0; k < terms; ++k)
        where[of->count].term[k].order = order;
    ++of->count;
}

/* Friction and cogging torque, of 500; without the friction it would be 600. */
void setUp(void)
{
    memset(list, 0, sizeof list);
    memset(others, 0, sizeof others);
    memset(&model, 0, sizeof model);
    memset(&rival, 0, sizeof rival);
    memset(&search, 0, sizeof search);
    memset(&r, 0, sizeof r);
    memset(&a, 0, sizeof a);
    memset(in, 0, sizeof in);
    model.candidates.candidate = list, rival.candidates.candidate = others;
    put(list, &model.candidates, "friction", 1, 0.0);
    put(list, &model.candidates, "cogging", 2, 6.0);
    model.fit = (hci_fit){.score = 500.0, .square = 400.0, .rows = 1000.0};
    r.search = &search, r.model = &model, r.type = type("friction");
    r.without.fit.score = 600.0;
}

void tearDown(void)
{
}

static bool promises(const char *name, double gain)
{
    const hci_candidate_model x = {.a = index_of(name), .b = index_of(name), .gain = gain, .in = in};
    return is_promising(&r, &x);
}

static bool never(const rivalry *of, const hci_candidate_model *x)
{
    (void)of, (void)x;
    return false;
}

/* Six tenths of 100 and 20 less. */
static void test_rivals_that_promise_enough(void)
{
    TEST_ASSERT_TRUE(promises("iron_drag", 40.1) && !promises("iron_drag", 39.9));
    TEST_ASSERT_FALSE(promises("friction", 90.0) || promises("cogging", 90.0)); /* itself, and what is in */
    r.unseen = true;
    TEST_ASSERT_TRUE(promises("iron_drag", 90.0));
    r.without.candidates = model.candidates;
    list[0].in = false;
    search.seen[search.seen_count++] = types_of(&model.candidates, type("iron_drag"));
    TEST_ASSERT_FALSE(promises("iron_drag", 90.0));
    TEST_ASSERT_TRUE(promises("back_emf", 90.0));
    r.unseen = false;
    TEST_ASSERT_TRUE(promises("iron_drag", 90.0));
    r.is_asked = never;
    TEST_ASSERT_FALSE(promises("iron_drag", 90.0));
}

static void test_models_that_were_seen(void)
{
    const uint32_t types = types_of(&model.candidates, NULL);
    TEST_ASSERT_EQUAL_HEX32((1u << index_of("friction")) | (1u << index_of("cogging")), types);
    TEST_ASSERT_EQUAL_HEX32(types | (1u << index_of("back_emf")),
                            types_of(&model.candidates, type("back_emf")));
    TEST_ASSERT_FALSE(is_seen(&search, types));
    hci_search_see(&search, &model.candidates);
    hci_search_see(&search, &model.candidates);
    TEST_ASSERT_TRUE(is_seen(&search, types) && search.seen_count == 1);
    search.seen_count = HCI_MOST_SEEN;
    list[0].in = false;
    hci_search_see(&search, &model.candidates);
    TEST_ASSERT_EQUAL_UINT64(HCI_MOST_SEEN, search.seen_count);
}

/* Of a list with the model and what the rival has of it. */
static void test_terms_and_their_costs(void)
{
    const hci_candidate_model x = {.in = in};
    r.models.list.candidate = others;
    put(others, &r.models.list, "cogging", 2, 6.0);
    put(others, &r.models.list, "iron_drag", 1, 0.0);
    put(others, &r.models.list, "back_emf", 1, 1.0);
    others[1].in = others[2].in = false, in[2] = true;
    TEST_ASSERT_EQUAL_UINT64(3, terms_of(&r, &x));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12,
                              hci_candidate_cost(&others[0], 1000.0) + hci_candidate_cost(&others[2], 1000.0),
                              cost_of(&r, &x));
}

static void test_margins(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(-10.0, margin_of(type("position_load"), type("reluctance")));
    TEST_ASSERT_EQUAL_DOUBLE(10.0, margin_of(type("reluctance"), type("position_load")));
    TEST_ASSERT_EQUAL_DOUBLE(10.0, margin_of(type("friction"), &hci_empirical_type));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, margin_of(type("friction"), type("iron_drag")));
    TEST_ASSERT_TRUE(is_called(type("position_load"), type("reluctance")) &&
                     is_called(type("reluctance"), type("position_load")));
    TEST_ASSERT_FALSE(is_called(type("friction"), type("iron_drag")));
    TEST_ASSERT_TRUE(is_of_its_own(type("friction"), type("iron_drag")));
    TEST_ASSERT_FALSE(is_of_its_own(type("friction"), &hci_empirical_type) ||
                      is_of_its_own(type("friction"), type("position_load")));
}

static bool takes_over(double score, const char *with, const char *in_place)
{
    hci_note note = {{0}};
    bool better = false;
    r.type = type(in_place), rival.fit.score = score;
    const size_t k = with ? index_of(with) : type_index(&hci_empirical_type);
    TEST_ASSERT_EQUAL_INT(HCI_OK, is_better(&r, &rival, k, &better, &note));
    return better;
}

/* Where no runs have to be asked. */
static void test_rivals_that_take_over(void)
{
    TEST_ASSERT_TRUE(takes_over(499.4, "iron_drag", "friction"));
    TEST_ASSERT_FALSE(takes_over(506.1, "iron_drag", "friction"));
    TEST_ASSERT_TRUE(takes_over(489.9, NULL, "friction") && !takes_over(490.1, NULL, "friction"));
    TEST_ASSERT_TRUE(takes_over(489.9, "position_load", "reluctance") &&
                     !takes_over(490.1, "position_load", "reluctance"));
    TEST_ASSERT_TRUE(takes_over(509.9, "reluctance", "position_load") &&
                     !takes_over(510.1, "reluctance", "position_load"));
}

static void test_rivals_are_marked(void)
{
    const size_t with = index_of("iron_drag"), of = index_of("friction");
    rival.fit.score = 503.0, rival.candidates = (hci_candidates){NULL, 0, 0.0};
    rival_mark(&r, with, &rival, &a);
    TEST_ASSERT_TRUE(a.verdict[with].ambiguous && a.verdict[of].ambiguous);
    TEST_ASSERT_EQUAL_PTR(type("friction"), a.verdict[with].rival_of);
    TEST_ASSERT_EQUAL_DOUBLE(97.0, a.verdict[with].gain);
    r.models.model[0] = (hci_candidate_model){.a = with, .gain = 30.1};
    r.models.model[1] = (hci_candidate_model){.a = index_of("back_emf"), .gain = 29.9};
    r.models.count = 2;
    plausible_mark(&r, &a);
    TEST_ASSERT_TRUE(a.plausible[of][with] && !a.plausible[of][index_of("back_emf")]);
}

/* Decisively no worse, with two values more. */
static void test_what_describes_as_well(void)
{
    rival.fit.square = 409.9, rival.fit.score = 700.0;
    put(others, &rival.candidates, "iron_drag", 3, 0.0);
    put(others, &rival.candidates, "cogging", 2, 6.0);
    TEST_ASSERT_TRUE(describes_as_well(&model, &rival));
    others[1].count = 3;
    TEST_ASSERT_FALSE(describes_as_well(&model, &rival));
    others[1].count = 2, rival.fit.square = 410.1;
    TEST_ASSERT_FALSE(describes_as_well(&model, &rival));
    rival.fit.square = 1.0, rival.fit.score = INFINITY;
    TEST_ASSERT_FALSE(describes_as_well(&model, &rival));
}

static void test_ripple_of_two_parts_of_the_iron(void)
{
    TEST_ASSERT_TRUE(is_of_ripple(&model.candidates, type("cogging")));
    list[1].term[1].order = 1.0;
    TEST_ASSERT_FALSE(is_of_ripple(&model.candidates, type("cogging")));
    list[1].in = false;
    TEST_ASSERT_TRUE(is_of_ripple(&model.candidates, type("cogging")));
    setUp();
    rival.fit.square = 405.0, rival.fit.score = 520.0;
    put(others, &rival.candidates, "back_emf", 2, 5.0);
    put(others, &rival.candidates, "friction", 2, 0.0);
    TEST_ASSERT_TRUE(is_same_ripple(&model, &rival, type("cogging"), type("back_emf")));
    TEST_ASSERT_FALSE(is_same_ripple(&model, &rival, type("cogging"), type("iron_drag")));
    TEST_ASSERT_FALSE(is_same_ripple(&model, &rival, type("friction"), type("back_emf")));
    others[1].count = 3;
    TEST_ASSERT_FALSE(is_same_ripple(&model, &rival, type("cogging"), type("back_emf")));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rivals_that_promise_enough);
    RUN_TEST(test_models_that_were_seen);
    RUN_TEST(test_terms_and_their_costs);
    RUN_TEST(test_margins);
    RUN_TEST(test_rivals_that_take_over);
    RUN_TEST(test_rivals_are_marked);
    RUN_TEST(test_what_describes_as_well);
    RUN_TEST(test_ripple_of_two_parts_of_the_iron);
    return UNITY_END();
}
