/* A compiled master for many walls on two storeys: Jacobi, held inputs, one thread.
 * It prints run time and memory.
 *
 *   cc -O2 -o master master.c -ldl -lm
 *   ./master WALL.so GUID a_bottom u_start thickness u reaction_bottom
 *            FLOOR.so GUID a_g reaction_1 reaction_2 mass stiffness acceleration_absolute reaction_bottom
 *            WALLS SECONDS STEP
 *
 * Each name stands for its value reference in modelDescription.xml; tests/coupling/compiled.py looks them up.
 * A floor has eight inputs for reactions. Forces on the same floor may be added and sent to one input.
 */
#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

typedef void *Component;
typedef unsigned int Reference;
typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, int);
    void *environment;
} Callbacks;

/* The functions of one library. */
typedef struct {
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int);
    void (*release)(Component);
    int (*setup)(Component, int, double, double, int, double);
    int (*enter)(Component);
    int (*leave)(Component);
    int (*get)(Component, const Reference *, size_t, double *);
    int (*set)(Component, const Reference *, size_t, const double *);
    int (*step)(Component, double, double, int);
} Library;

static const double PI = 3.14159265358979323846;

static void fail(const char *what)
{
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static void check(int status, const char *what)
{
    if (status > 1)
        fail(what);
}

static void say(void *environment, const char *name, int status, const char *category,
                const char *message, ...)
{
    va_list arguments;
    (void)environment;
    (void)status;
    fprintf(stderr, "%s, %s: ", name, category);
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

static const Callbacks CALLBACKS = {say, calloc, free, NULL, NULL};

static void *symbol(void *library, const char *name)
{
    void *found = dlsym(library, name);
    if (!found)
        fail(name);
    return found;
}

static Library load(const char *path)
{
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    Library found;
    if (!library)
        fail(dlerror());
    *(void **)&found.instantiate = symbol(library, "fmi2Instantiate");
    *(void **)&found.release = symbol(library, "fmi2FreeInstance");
    *(void **)&found.setup = symbol(library, "fmi2SetupExperiment");
    *(void **)&found.enter = symbol(library, "fmi2EnterInitializationMode");
    *(void **)&found.leave = symbol(library, "fmi2ExitInitializationMode");
    *(void **)&found.get = symbol(library, "fmi2GetReal");
    *(void **)&found.set = symbol(library, "fmi2SetReal");
    *(void **)&found.step = symbol(library, "fmi2DoStep");
    return found;
}

static Component make(const Library *library, const char *guid, const char *name)
{
    Component made = library->instantiate(name, 1, guid, NULL, &CALLBACKS, 0, 0);
    if (!made)
        fail("fmi2Instantiate");
    check(library->setup(made, 0, 0.0, 0.0, 0, 0.0), "fmi2SetupExperiment");
    return made;
}

static void begin(const Library *library, Component unit)
{
    check(library->enter(unit), "fmi2EnterInitializationMode");
    check(library->leave(unit), "fmi2ExitInitializationMode");
}

static double get(const Library *library, Component unit, Reference reference)
{
    double value;
    check(library->get(unit, &reference, 1, &value), "fmi2GetReal");
    return value;
}

static void set(const Library *library, Component unit, Reference reference, double value)
{
    check(library->set(unit, &reference, 1, &value), "fmi2SetReal");
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

/* Resident memory in bytes. */
static double resident(void)
{
    long pages = 0, total = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file) {
        if (fscanf(file, "%ld %ld", &total, &pages) != 2)
            pages = 0;
        fclose(file);
    }
    return (double)pages * sysconf(_SC_PAGESIZE);
}

/* Ground acceleration: ten seconds of two sines that grow and decay. */
static double ground(double t)
{
    return 1.5 * sin(0.1 * PI * t) * (sin(2 * PI * 1.3 * t) + 0.6 * sin(2 * PI * 3.1 * t));
}

int main(int count, char **arguments)
{
    if (count != 20)
        fail("usage: see the head of master.c");
    Reference r[20];
    for (int index = 1; index < count; index++)
        r[index] = (Reference)strtoul(arguments[index], NULL, 10);
    const Reference a_bottom = r[3], u_start = r[4], thickness = r[5], u = r[6], reaction = r[7];
    const Reference a_g = r[10], loads[2] = {r[11], r[12]}, mass = r[13], stiffness = r[14];
    const Reference absolute = r[15], below = r[16];
    const int walls = atoi(arguments[17]);
    const double seconds = atof(arguments[18]), step = atof(arguments[19]);
    const Library wall = load(arguments[1]), storey = load(arguments[8]);
    const double before = resident();
    Component *standing = calloc(walls, sizeof *standing);
    Component floors[2];
    if (walls < 1 || !standing)
        fail("at least one wall");
    for (int index = 0; index < walls; index++) {
        char name[32];
        snprintf(name, sizeof name, "wall_%d", index + 1);
        standing[index] = make(&wall, arguments[2], name);
        set(&wall, standing[index], u_start, 0.0);
        /* 0.2 to 0.4 m */
        set(&wall, standing[index], thickness, 0.2 + 0.2 * index / walls);
        begin(&wall, standing[index]);
    }
    const double each = (resident() - before) / walls;
    for (int index = 0; index < 2; index++) {
        floors[index] = make(&storey, arguments[9], index ? "floor_2" : "floor_1");
        /* 12 t for each of its walls; 4 Hz alone */
        set(&storey, floors[index], mass, 6e3 * walls);
        set(&storey, floors[index], stiffness, 6e3 * walls * 4 * PI * PI * 16);
        begin(&storey, floors[index]);
    }
    const double start = now();
    const long steps = lround(seconds / step);
    double largest = 0.0;
    for (long index = 0; index < steps; index++) {
        const double time = index * step;
        double force[2] = {0.0, 0.0}, motion[2];
        for (int at = 0; at < 2; at++)
            motion[at] = get(&storey, floors[at], absolute);
        const double upper = get(&storey, floors[1], below);
        for (int at = 0; at < walls; at++) {
            force[at % 2] += get(&wall, standing[at], reaction);
            set(&wall, standing[at], a_bottom, motion[at % 2]);
        }
        set(&storey, floors[0], a_g, ground(time));
        set(&storey, floors[1], a_g, motion[0]);
        set(&storey, floors[0], loads[0], force[0]);
        set(&storey, floors[0], loads[1], upper);
        set(&storey, floors[1], loads[0], force[1]);
        for (int at = 0; at < walls; at++)
            check(wall.step(standing[at], time, step, 1), "fmi2DoStep");
        for (int at = 0; at < 2; at++)
            check(storey.step(floors[at], time, step, 1), "fmi2DoStep");
        largest = fmax(largest, fabs(get(&wall, standing[0], u)));
    }
    printf("{\"walls\": %d, \"simulated_s\": %g, \"step_s\": %g, \"run_time_s\": %.3f, "
           "\"bytes_per_wall\": %.0f, \"u_max_of_wall_1_m\": %.17g, \"u_of_last_wall_m\": %.17g}\n",
           walls, seconds, step, now() - start, each, largest, get(&wall, standing[walls - 1], u));
    for (int index = 0; index < walls; index++)
        wall.release(standing[index]);
    for (int index = 0; index < 2; index++)
        storey.release(floors[index]);
    free(standing);
    return 0;
}
