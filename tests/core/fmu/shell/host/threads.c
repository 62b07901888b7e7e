/* Several FMUs of FMI 2.0, two instances of each: one after the other, then all at once in threads.
   Standard input: one line for each FMU, "LIBRARY GUID STEPS INPUTS [REFERENCE LOW HIGH]... OUTPUTS
   [REFERENCE]..."; the folder of the library is that of the resources. Prints for each instance a hash of all its answers, alone and beside others. */
#include <dlfcn.h>
#include <libgen.h>
#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>

#include "fmi2Functions.h"

#define MOST 64
#define NEED(name) fmi2##name##TYPE *name = (fmi2##name##TYPE *)dlsym(job->library, "fmi2" #name)

typedef struct {
    void *library;
    char guid[64], resources[1024];
    int n_steps, n_inputs, n_outputs;
    fmi2ValueReference inputs[MOST], outputs[MOST];
    double low[MOST], high[MOST];
} Job;

typedef struct { const Job *job; int variant; uint64_t hash; } Run;

static uint64_t mix(uint64_t hash, const void *data, size_t n)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}

/* Inputs that jump about inside their ranges, other ones for each variant. */
static void choose_inputs(const Run *run, int step, double *values)
{
    const Job *job = run->job;
    for (int k = 0; k < job->n_inputs; k++) {
        double share = fmod(0.37 * (step + 1) * (k + 1) + 0.11 * run->variant, 1.0);
        values[k] = job->low[k] + share * (job->high[k] - job->low[k]);
    }
}

static void *simulate(void *argument)
{
    Run *run = argument;
    const Job *job = run->job;
    NEED(Instantiate); NEED(FreeInstance); NEED(EnterInitializationMode); NEED(GetReal);
    NEED(ExitInitializationMode); NEED(SetReal); NEED(DoStep);
    fmi2CallbackFunctions callbacks = {NULL, NULL, NULL, NULL, NULL};
    double in[MOST], out[MOST] = {0};
    run->hash = 14695981039346656037u;
    void *m = Instantiate("thread", fmi2CoSimulation, job->guid, job->resources, &callbacks, 0, 0);
    if (!m)
        return NULL;
    EnterInitializationMode(m);
    ExitInitializationMode(m);
    for (int i = 0; i < job->n_steps; i++) {
        choose_inputs(run, i, in);
        int rc[3] = {SetReal(m, job->inputs, (size_t)job->n_inputs, in),
                     DoStep(m, i * 1e-3, 1e-3, 1),
                     GetReal(m, job->outputs, (size_t)job->n_outputs, out)};
        run->hash = mix(mix(run->hash, rc, sizeof rc), out, sizeof out);
    }
    FreeInstance(m);
    return NULL;
}

static int read_job(Job *job)
{
    char path[1024];
    if (scanf("%1023s %63s %d %d", path, job->guid, &job->n_steps, &job->n_inputs) != 4)
        return 0;
    for (int k = 0; k < job->n_inputs; k++) {
        if (scanf("%u %lf %lf", &job->inputs[k], &job->low[k], &job->high[k]) != 3)
            return 0;
    }
    if (scanf("%d", &job->n_outputs) != 1)
        return 0;
    for (int k = 0; k < job->n_outputs; k++) {
        if (scanf("%u", &job->outputs[k]) != 1)
            return 0;
    }
    job->library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    snprintf(job->resources, sizeof job->resources, "%s", dirname(path));
    return job->library != NULL;
}

int main(void)
{
    static Job jobs[8];
    static Run alone[16], beside[16];
    pthread_t threads[16];
    int n = 0;
    for (int j = 0; j < 8 && read_job(&jobs[j]); j++) {
        for (int variant = 0; variant < 2; variant++, n++)
            alone[n] = beside[n] = (Run){&jobs[j], variant, 0};
    }
    for (int i = 0; i < n; i++)
        simulate(&alone[i]);
    for (int i = 0; i < n; i++)
        pthread_create(&threads[i], NULL, simulate, &beside[i]);
    for (int i = 0; i < n; i++)
        pthread_join(threads[i], NULL);
    for (int i = 0; i < n; i++)
        printf("%016llx %016llx\n", (unsigned long long)alone[i].hash,
               (unsigned long long)beside[i].hash);
    return 0;
}
