/* tests/unit/test_bsdf_hostile.c -- BSDF files that break their format: refused by file and line.
 */
#include "tests/bsdf_twin.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEAD(structure)                                                                            \
    "<WindowElement><Optical><Layer>\n<DataDefinition>\n"                                          \
    "<IncidentDataStructure>" structure "</IncidentDataStructure>\n"
#define BLOCK(bases)                                                                               \
    "</DataDefinition>\n<WavelengthData><Wavelength>Visible</Wavelength>\n<WavelengthDataBlock>\n" \
    "<WavelengthDataDirection>Transmission Front</WavelengthDataDirection>\n" bases                \
    "\n<ScatteringDataType>BTDF</ScatteringDataType>\n<ScatteringData>\n"
#define KLEMS(name)                                                                                \
    "<ColumnAngleBasis>" name "</ColumnAngleBasis><RowAngleBasis>" name "</RowAngleBasis>"
#define TREE "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>"
#define TAIL                                                                                       \
    "\n</ScatteringData>\n</WavelengthDataBlock>\n</WavelengthData>\n</Layer></Optical></"         \
    "WindowElement>\n"
#define RING(low, high, n)                                                                         \
    "<AngleBasisBlock><nPhis>" n "</nPhis><ThetaBounds><LowerTheta>" low                           \
    "</LowerTheta><UpperTheta>" high "</UpperTheta></ThetaBounds></AngleBasisBlock>\n"
#define OWN(rings) "<AngleBasis><AngleBasisName>own</AngleBasisName>\n" rings "</AngleBasis>\n"

/* A basis of two cells, and so four numbers; trees: the data begin on
 * lines 15 and 11 */
#define TWO(data)                                                                                  \
    HEAD("Columns") OWN(RING("0", "45", "1") RING("45", "90", "1")) BLOCK(KLEMS("own")) data TAIL
#define TENSOR(n, data) HEAD("TensorTree" n) BLOCK(TREE) data TAIL

static void refused(const char *text, error_code code, const char *want)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    assert_null(twin_read(&a, text, NULL, &err));
    if (strncmp(err.text, want, strlen(want)) != 0 || err.code != code)
        fail_msg("\"%s\" (%d) where \"%s\" (%d) is wanted", err.text, err.code, want, code);
    assert_null(strpbrk(err.text, "\n\r\x1b"));
    arena_clear(&a);
}

static void taken(const char *text)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    if (!twin_read(&a, text, NULL, &err))
        fail_msg("%s", err.text);
    arena_clear(&a);
}

TEST(good_files_are_taken)
{
    taken(TWO("0.1 0.2\n0.2 0.1"));
    taken(TWO("0.1, 0.2,\n0.2, 0.1,\n"));
    taken("a line that a tool left\n" TWO("0 0 0 0"));
    taken(TENSOR("3", "{ 0.1 }"));
    taken(TENSOR("4", "{ 0.1 }"));
    taken(TENSOR("3", "{ 1 2 3 4 5 6 7 8 }"));
    taken(TENSOR("3", "{ {1},{1},{1},{1}, {1}{1}{1}{1, 1, 1, 1 1 1 1 1} }"));
}

TEST(wrong_numbers_are_refused)
{
    refused(TWO("0.1 0.2 0.2"), ERR_FORMAT, "a.xml:15: ScatteringData: no number");
    refused(TWO("0.1 0.2\n0.2 0.1\n5"), ERR_FORMAT, "a.xml:17: ScatteringData: more than 2 x 2");
    refused(TWO("0.1 0.2\nnan 0.1"), ERR_FORMAT, "a.xml:16: ScatteringData: no number");
    refused(TWO("0.1 inf 0.2 0.1"), ERR_FORMAT, "a.xml:15: ScatteringData: no number");
    refused(TWO("0.1 0.2\n0.2 -0.1"), ERR_FORMAT, "a.xml:16: ScatteringData: -0.1 is not in");
    refused(TWO("0.1 1e300 0.2 0.1"), ERR_FORMAT, "a.xml:15: ScatteringData: 1e+300 is not in");
    refused(TWO("0.1 1e999 0.2 0.1"), ERR_FORMAT, "a.xml:15: ScatteringData: no number");
    refused(TWO("0.1 0.2x 0.2 0.1"), ERR_FORMAT, "a.xml:15: ScatteringData: no number");
    refused(TWO("0.1,,0.2 0.2 0.1"), ERR_FORMAT, "a.xml:15: ScatteringData: no number");
    refused(TWO(""), ERR_FORMAT, "a.xml:");
    refused("left by a tool\n" TWO("x 2 2 2"), ERR_FORMAT, "a.xml:16: ScatteringData: no number");
}

TEST(wrong_bases_are_refused)
{
    refused(HEAD("Columns") OWN(RING("0", "45", "1")) BLOCK(KLEMS("own")) "1" TAIL, ERR_FORMAT,
            "a.xml:6: AngleBasis \"own\" of line 4: polar angles that do not ascend to 90");
    refused(HEAD("Columns") OWN(RING("0", "90", "1000000000")) BLOCK(KLEMS("own")) "1" TAIL,
            ERR_FORMAT, "a.xml:6: AngleBasis \"own\" of line 4: numbers of azimuths");
    refused(HEAD("Columns") OWN(RING("0", "90", "-3")) BLOCK(KLEMS("own")) "1" TAIL, ERR_FORMAT,
            "a.xml:6: AngleBasis \"own\" of line 4: numbers of azimuths");
    refused(HEAD("Columns") OWN(RING("0", "90", "1.5")) BLOCK(KLEMS("own")) "1" TAIL, ERR_FORMAT,
            "a.xml:6: AngleBasis \"own\" of line 4: numbers of azimuths");
    refused(HEAD("Columns") OWN(RING("0", "x", "1")) BLOCK(KLEMS("own")) "1" TAIL, ERR_FORMAT,
            "a.xml:5: UpperTheta: no number");
    refused(HEAD("Columns") OWN("") BLOCK(KLEMS("own")) "1" TAIL, ERR_FORMAT,
            "a.xml:5: AngleBasis \"own\" of line 4: not 1 to 48 rings");
    refused(HEAD("Columns") BLOCK(KLEMS("own")) "1" TAIL, ERR_FORMAT,
            "a.xml:6: a ColumnAngleBasis that is not known");
    refused(HEAD("Columns") BLOCK("") "1" TAIL, ERR_FORMAT, "a.xml:6: a ColumnAngleBasis");
    refused(HEAD("Columns") BLOCK("<ColumnAngleBasis>LBNL/Klems Full</ColumnAngleBasis>") "1" TAIL,
            ERR_UNSUPPORTED, "a.xml:6: angle bases that differ");
    refused(HEAD("TensorTree4") BLOCK(KLEMS("LBNL/Klems Full")) "{ 1 }" TAIL, ERR_UNSUPPORTED,
            "a.xml:6: a tensor tree whose AngleBasis is not LBNL/Shirley-Chiu");
}

TEST(wrong_trees_are_refused)
{
    refused(TENSOR("3", "1"), ERR_FORMAT, "a.xml:11: tensor tree: no {");
    refused(TENSOR("3", ""), ERR_FORMAT, "a.xml:");
    refused(TENSOR("3", "{ 1 2 }"), ERR_FORMAT, "a.xml:11: tensor tree: numbers that fill no grid");
    refused(TENSOR("3", "{ }"), ERR_FORMAT, "a.xml:11: tensor tree: numbers that fill no grid");
    refused(TENSOR("3", "{\n1 "), ERR_FORMAT, "a.xml:12: ScatteringData: no number");
    refused(TENSOR("3", "{ {1}\n{1} }"), ERR_FORMAT,
            "a.xml:11: tensor tree: a branch with too few");
    refused(TENSOR("3", "{ {1}{1}{1}{1}{1}{1}{1} }"), ERR_FORMAT, "a.xml:11: tensor tree: ");
    refused(TENSOR("4", "{ {1}{1}{1}{1}{1}{1}{1}{1} }"), ERR_FORMAT, "a.xml:11: tensor tree: a br");
    refused(TENSOR("3", "{ 1 } }"), ERR_FORMAT, "a.xml:11: tensor tree: more behind");
    refused(TENSOR("3", "{ nan }"), ERR_FORMAT, "a.xml:11: ScatteringData: no number");
    refused(TENSOR("3", "{ -1 }"), ERR_FORMAT, "a.xml:11: ScatteringData: -1 is not in");
    refused(TENSOR("3", "{ {1}{1}{1}{1}{1}{1}{1}{1}{1} }"), ERR_FORMAT,
            "a.xml:11: tensor tree: no }");
}

TEST(braces_nested_deep_are_refused)
{
    enum { DEEP = 200000 };
    char *text = calloc(DEEP + 2000, 1);
    assert_non_null(text);
    strcpy(text, HEAD("TensorTree3") BLOCK(TREE));
    memset(text + strlen(text), '{', DEEP);
    strcat(text, TAIL);
    refused(text, ERR_FORMAT, "a.xml:11: tensor tree: braces nested deeper than 12");
    free(text);
}

TEST(missing_elements_are_named)
{
    refused("", ERR_FORMAT, "a.xml:1: XML: ");
    refused("no XML\nat all\n", ERR_FORMAT, "a.xml:");
    refused("<WindowElement/>", ERR_FORMAT,
            "a.xml:1: no BSDF: an IncidentDataStructure is missing");
    refused(HEAD("Columns") "</DataDefinition></Layer></Optical></WindowElement>", ERR_FORMAT,
            "a.xml:1: no ScatteringData of visible light");
    refused(HEAD("Planes") "</DataDefinition></Layer></Optical></WindowElement>", ERR_UNSUPPORTED,
            "a.xml:3: IncidentDataStructure \"Planes\"");
    refused(HEAD("\x1b[2J\xc3\xa4") "</DataDefinition>", ERR_FORMAT, "a.xml:3: XML: ");
    refused(HEAD("Columns") "</DataDefinition><WavelengthData><Wavelength>Visible</Wavelength>"
                            "<WavelengthDataBlock>\n</WavelengthDataBlock>",
            ERR_FORMAT, "a.xml:5: a WavelengthDataBlock without WavelengthDataDirection");
    refused(HEAD("Columns") "</DataDefinition><WavelengthData><Wavelength>Visible</Wavelength>"
                            "<WavelengthDataBlock><WavelengthDataDirection>Reflection Back"
                            "</WavelengthDataDirection></WavelengthDataBlock>",
            ERR_FORMAT, "a.xml:4: a WavelengthDataBlock without ScatteringData");
    refused(HEAD("Columns") "</DataDefinition><WavelengthData><Wavelength>Visible</Wavelength>"
                            "<WavelengthDataBlock><WavelengthDataDirection>Upward"
                            "</WavelengthDataDirection>",
            ERR_FORMAT, "a.xml:4: WavelengthDataDirection \"Upward\"");
}

TEST(a_file_cut_short_anywhere_is_refused)
{
    const char *whole = TENSOR("3", "{ {1}{1}{1}{1}{1}{1}{1}{1} }");
    char *text        = strdup(whole);
    assert_non_null(text);
    for (size_t length = strlen(whole) - 2; length < strlen(whole); length -= 7) {
        text[length] = '\0';
        refused(text, ERR_FORMAT, "a.xml:");
    }
    free(text);
}

TEST(the_same_part_twice_is_refused)
{
    refused(HEAD("TensorTree3")
                BLOCK(TREE) "{ 1 }</ScatteringData></WavelengthDataBlock>"
                            "<WavelengthDataBlock>\n<WavelengthDataDirection>transmission front"
                            "</WavelengthDataDirection>" TREE "<ScatteringData>{ 1 }" TAIL,
            ERR_UNSUPPORTED, "a.xml:14: the same WavelengthDataDirection as that of line 6");
}

/* Ten times ten times ... of an entity; one that would be read from elsewhere */
TEST(entities_are_refused)
{
    refused("<?xml version=\"1.0\"?>\n<!DOCTYPE w [<!ENTITY a \"ha\">\n<!ENTITY b "
            "\"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\">\n<!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;&b;\">]>\n"
            "<w>&c;</w>",
            ERR_UNSUPPORTED, "a.xml:2: a document type (DOCTYPE)");
    refused("<!DOCTYPE w SYSTEM \"/etc/hostname\"><w/>", ERR_UNSUPPORTED,
            "a.xml:1: a document type");
    refused("<w>&undefined;</w>", ERR_FORMAT, "a.xml:1: XML: ");
}

TEST(elements_nested_deep_are_refused)
{
    char text[3000] = "";
    for (int i = 0; i < 100; i++)
        strcat(text, "<w>\n");
    refused(text, ERR_FORMAT, "a.xml:65: XML nested deeper than 64");
}

TEST(no_file_and_no_memory_are_errors)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    assert_null(bsdf_read(&a, "no/such.xml", NULL, &err));
    assert_int_equal(err.code, ERR_IO);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_files_are_taken),
        cmocka_unit_test(wrong_numbers_are_refused),
        cmocka_unit_test(wrong_bases_are_refused),
        cmocka_unit_test(wrong_trees_are_refused),
        cmocka_unit_test(braces_nested_deep_are_refused),
        cmocka_unit_test(missing_elements_are_named),
        cmocka_unit_test(a_file_cut_short_anywhere_is_refused),
        cmocka_unit_test(the_same_part_twice_is_refused),
        cmocka_unit_test(entities_are_refused),
        cmocka_unit_test(elements_nested_deep_are_refused),
        cmocka_unit_test(no_file_and_no_memory_are_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
