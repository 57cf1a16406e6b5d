/* Repeats recorded FMI 2.0 calls on a Windows library and compares what it returns, bit for bit.
 *
 *   driver.exe LIBRARY GUID RESOURCES < CALLS
 *
 * Each line of CALLS is a call with its arguments; reals are the 16 hexadecimal digits of their bits:
 *
 *   setup TOLERANCE_DEFINED TOLERANCE START   enter   exit   step TIME SIZE
 *   real REFERENCE VALUE   integer REFERENCE VALUE   boolean REFERENCE VALUE   rate REFERENCE VALUE
 *   get REFERENCE EXPECTED   truth REFERENCE EXPECTED   save FILE   resume FILE
 *
 * It prints each value that differs as `REFERENCE EXPECTED FOUND`, then the number of values compared. The
 * locale is one with a decimal comma, if there is one.
 */
#include <inttypes.h>
#include <locale.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#define MOST_BYTES 65536

typedef void *Component;
typedef unsigned int Reference;
typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, int);
    void *environment;
} Callbacks;

static HMODULE library;
static unsigned line;

static void fail(const char *what)
{
    fprintf(stderr, "line %u: %s\n", line, what);
    exit(1);
}

static void check(int status)
{
    if (status > 1)
        fail("the call failed");
}

static void say(void *environment, const char *name, int status, const char *category,
                const char *message, ...)
{
    va_list arguments;
    (void)environment;
    fprintf(stderr, "%s, %d, %s: ", name, status, category);
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

static const Callbacks CALLBACKS = {say, calloc, free, NULL, NULL};

static FARPROC function(const char *name)
{
    FARPROC found = GetProcAddress(library, name);
    if (!found)
        fail(name);
    return found;
}

static double real(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint64_t bits(double value)
{
    uint64_t found;
    memcpy(&found, &value, sizeof found);
    return found;
}

/* Writes the state of a unit to a file. */
static void save(Component unit, const char *path)
{
    int (*get)(Component, void **) = (void *)function("fmi2GetFMUstate");
    int (*size_of)(Component, void *, size_t *) = (void *)function("fmi2SerializedFMUstateSize");
    int (*serialize)(Component, void *, char *, size_t) = (void *)function("fmi2SerializeFMUstate");
    int (*release)(Component, void **) = (void *)function("fmi2FreeFMUstate");
    static char bytes[MOST_BYTES];
    void *state = NULL;
    size_t size = 0;
    check(get(unit, &state));
    check(size_of(unit, state, &size));
    if (size > sizeof bytes)
        fail("the state is too long");
    check(serialize(unit, state, bytes, size));
    check(release(unit, &state));
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file))
        fail("the state cannot be written");
}

/* Puts a unit into the state that a file has. */
static void resume(Component unit, const char *path)
{
    int (*deserialize)(Component, const char *, size_t, void **) =
        (void *)function("fmi2DeSerializeFMUstate");
    int (*set)(Component, void *) = (void *)function("fmi2SetFMUstate");
    int (*release)(Component, void **) = (void *)function("fmi2FreeFMUstate");
    static char bytes[MOST_BYTES];
    void *state = NULL;
    FILE *file = fopen(path, "rb");
    if (!file)
        fail("the state cannot be read");
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    check(deserialize(unit, bytes, size, &state));
    check(set(unit, state));
    check(release(unit, &state));
}

int main(int count, char **arguments)
{
    if (count != 4)
        fail("usage: driver.exe LIBRARY GUID RESOURCES < CALLS");
    setlocale(LC_ALL, "de-DE");
    library = LoadLibraryA(arguments[1]);
    if (!library)
        fail("the library cannot be loaded");
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int) =
        (void *)function("fmi2Instantiate");
    int (*setup)(Component, int, double, double, int, double) = (void *)function("fmi2SetupExperiment");
    int (*enter)(Component) = (void *)function("fmi2EnterInitializationMode");
    int (*leave)(Component) = (void *)function("fmi2ExitInitializationMode");
    int (*step)(Component, double, double, int) = (void *)function("fmi2DoStep");
    int (*set_real)(Component, const Reference *, size_t, const double *) = (void *)function("fmi2SetReal");
    int (*set_integer)(Component, const Reference *, size_t, const int *) =
        (void *)function("fmi2SetInteger");
    int (*set_boolean)(Component, const Reference *, size_t, const int *) =
        (void *)function("fmi2SetBoolean");
    int (*set_rate)(Component, const Reference *, size_t, const int *, const double *) =
        (void *)function("fmi2SetRealInputDerivatives");
    int (*get_real)(Component, const Reference *, size_t, double *) = (void *)function("fmi2GetReal");
    int (*get_boolean)(Component, const Reference *, size_t, int *) = (void *)function("fmi2GetBoolean");
    void (*release)(Component) = (void *)function("fmi2FreeInstance");

    Component unit = instantiate("unit", 1, arguments[2], arguments[3], &CALLBACKS, 0, 1);
    if (!unit)
        fail("fmi2Instantiate");
    char word[16], path[256];
    uint64_t first, second, third;
    unsigned compared = 0;
    const int order = 1;
    while (++line, scanf("%15s", word) == 1) {
        if (!strcmp(word, "enter")) {
            check(enter(unit));
            continue;
        }
        if (!strcmp(word, "exit")) {
            check(leave(unit));
            continue;
        }
        if (!strcmp(word, "save") || !strcmp(word, "resume")) {
            if (scanf("%255s", path) != 1)
                fail("a path is missing");
            (word[0] == 's' ? save : resume)(unit, path);
            continue;
        }
        if (scanf("%" SCNx64 " %" SCNx64, &first, &second) != 2)
            fail("two numbers are missing");
        const Reference reference = (Reference)first;
        const int whole = (int)second;
        const double value = real(second);
        double found;
        int truth;
        if (!strcmp(word, "setup")) {
            if (scanf("%" SCNx64, &third) != 1)
                fail("the start is missing");
            check(setup(unit, (int)first, value, real(third), 0, 0.0));
        } else if (!strcmp(word, "step")) {
            check(step(unit, real(first), value, 1));
        } else if (!strcmp(word, "real")) {
            check(set_real(unit, &reference, 1, &value));
        } else if (!strcmp(word, "integer")) {
            check(set_integer(unit, &reference, 1, &whole));
        } else if (!strcmp(word, "boolean")) {
            check(set_boolean(unit, &reference, 1, &whole));
        } else if (!strcmp(word, "rate")) {
            check(set_rate(unit, &reference, 1, &order, &value));
        } else if (!strcmp(word, "get")) {
            check(get_real(unit, &reference, 1, &found));
            compared++;
            if (bits(found) != second)
                printf("%u %016" PRIx64 " %016" PRIx64 "\n", reference, second, bits(found));
        } else if (!strcmp(word, "truth")) {
            check(get_boolean(unit, &reference, 1, &truth));
            compared++;
            if (truth != whole)
                fail("a Boolean differs");
        } else {
            fail("is not a call");
        }
    }
    release(unit);
    printf("%u compared\n", compared);
    return 0;
}
