// SPDX-License-Identifier: MIT
// Runs the operations of the kernels on a device, and compares the results with results of the
// host. `cases` holds operands for which common faults give other bits than IEEE 754. These faults
// are wrong rounding, contracted products, flushed denormals and conversions that truncate.
//
// If the first program of a process must be compiled, program.c appends this test's kernel to it. A
// separate program would take PoCL another 0.5 s. If the first program is from the cache, the
// device has already passed the test with the same driver and options.
#include "device/arithmetic.h"

#include "device/buffer.h"

#include <math.h>
#include <string.h>

#define OPERATIONS 12
#define CASES      (sizeof cases / sizeof *cases)

static const char *const operations[OPERATIONS] = {
    "a + b",       "a - b", "a * b",          "a * b + c",      "fma",         "a / b", "sqrt",
    "min and max", "rint",  "ulong to float", "float to ulong", "a comparison"};
enum { QUOTIENT = 5, ROOT = 6 };

static const float cases[][3] = {
    {1.0f, 3.0f, 0x1.555556p-2f},                        // a repeating quotient
    {0x1.000002p+0f, 0x1.000002p+0f, -0x1.000004p+0f},   // the product's error, 2^-46
    {0x1.fffffep+0f, 0x1.fffffep+0f, -0x1.fffffcp+1f},   // a product's largest error
    {0x1.000002p+0f, 0x1.fffffcp-1f, -1.0f},             // a product next to 1
    {0x1.000002p+0f, 0x1.fffffep-1f, 0x1p-60f},          // an addend far below the product
    {0x1p+0f, 0x1p-24f, 0x1p-50f},                       // halfway to the next float: to even
    {0x1.000002p+0f, 0x1p-24f, -0x1p-50f},               // halfway, upward
    {-0x1.000002p+0f, -0x1.000002p-24f, 0x1p+0f},        // just beyond halfway
    {0x1.fffffep+0f, 0x1p-24f, 1.0f},                    // carries into the next power of two
    {0x1.7ffffep+0f, 0x1.800002p+0f, -0x1.2p+1f},        // cancellation
    {16777215.0f, 1.5f, 0.5f},                           // the largest odd float
    {2.5f, -3.5f, 4.5f},                                 // rint to even
    {-0.5f, 0.5f, 0.25f},                                // rint to a negative zero
    {8388609.0f, 7.0f, -1.0f},                           // sums without a fraction
    {0x1.000006p+0f, 0x1.000004p+0f, 1.0f},              // a quotient next to 1
    {0x1.921fb6p+1f, 0x1.5bf0a8p+1f, 0x1.6a09e6p+0f},    // pi, e and the root of 2
    {0x1.fffffap+1f, 0x1.555554p-1f, 0x1.333334p-3f},    // a root just below 2
    {0x1.fffffcp-1f, 0x1.99999ap-4f, 0x1.99999ap-4f},    // a root next to 1
    {0x1.6a09e8p+0f, 0x1.6a09e6p+0f, -2.0f},             // near the root of 2
    {0x1.8p+127f, 0x1.8p+0f, -0x1p+127f},                // only a fused product does not overflow
    {0x1.fffffep+127f, 0x1p-126f, 0x1p-24f},             // the largest and smallest normals
    {0x1p-100f, 0x1p-26f, 0x1.8p-126f},                  // a product: the smallest normal
    {0x1.234568p-64f, 0x1.fedcbap-61f, -0x1.2p-125f},    // a product near the smallest normal
    {0x1.8p-126f, 0x1p-126f, -0x1p-126f},                // a denormal difference
    {0x1.00001p-130f, 3.0f, 0x1p-149f},                  // a denormal operand
    {0x1p-149f, 0x1p-149f, 0x1p-149f},                   // the smallest denormal
    {0x1.6p-75f, 0x1.ap-72f, 0x1.4p-140f},               // a denormal product
    {0x1.234p-140f, 0x1p+60f, -0x1.234p-80f},            // from a denormal back to normals
    {INFINITY, 0x1.8p+1f, -INFINITY},                    // infinities
    {-1.0f, INFINITY, 1.0f},                             // an infinite denominator
    {0x1.2aaaaap+3f, 0x1.8p+2f, 0x1.8p+2f},              // conversions of long integers
    {-0x1.555556p+30f, 0x1.000002p-30f, 0x1.fffffep+0f}, // a product next to -4/3
};

typedef struct {
    uint32_t words[OPERATIONS];
} Results;

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static float value_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static Results results_of(const float operands[3])
{
    const float a = operands[0], b = operands[1], c = operands[2];
    const float product = a * b, size = fabsf(a), larger = a > b ? a : b;
    const uint64_t joined = (uint64_t)bits_of(a) << 32 | bits_of(b);
    return (Results){{bits_of(a + b), bits_of(a - b), bits_of(product), bits_of(product + c),
                      bits_of(fmaf(a, b, c)), bits_of(a / b), bits_of(sqrtf(size)),
                      bits_of(larger < c ? larger : c), bits_of(rintf(a)), bits_of((float)joined),
                      (uint32_t)(uint64_t)(size < 0x1p31f ? size : 1.0f),
                      (a < b ? 1u : 0u) | (a <= c ? 2u : 0u) | (a == -b ? 4u : 0u)}};
}

static bool is_denormal(float value)
{
    return fpclassify(value) == FP_SUBNORMAL;
}

static bool has_denormals(const float operands[3], uint32_t result)
{
    return is_denormal(operands[0]) || is_denormal(operands[1]) || is_denormal(operands[2]) ||
           is_denormal(operands[0] * operands[1]) || is_denormal(value_of(result));
}

// The device's promises: to keep denormal numbers, and to round quotients and roots correctly.
typedef struct {
    bool denormals, quotients;
} Promise;

static bool is_promised(const Promise *promise, const float operands[3], size_t operation,
                        uint32_t right)
{
    const bool is_quotient = operation == QUOTIENT || operation == ROOT;
    return (promise->quotients || !is_quotient) &&
           (promise->denormals || !has_denormals(operands, right));
}

static bool refuse(const Device *device, const float operands[3], const char *operation,
                   uint32_t bits, Error *error)
{
    return error_set(error,
                     "%s calculates wrongly, so clrt cannot use it: for a = %a, b = %a and c = %a, "
                     "%s has the bits 0x%08x",
                     device->facts.name, (double)operands[0], (double)operands[1],
                     (double)operands[2], operation, bits);
}

static bool compare(const Device *device, const Promise *promise, const Results *found,
                    Error *error)
{
    for (size_t i = 0; i < CASES; i++) {
        const Results exact = results_of(cases[i]);
        for (size_t k = 0; k < OPERATIONS; k++) {
            const uint32_t right = exact.words[k], word = found[i].words[k];
            const bool both_nan = isnan(value_of(right)) && isnan(value_of(word));
            if (word != right && !both_nan && is_promised(promise, cases[i], k, right))
                return refuse(device, cases[i], operations[k], word, error);
        }
    }
    return true;
}

static bool launch(const Device *device, cl_program program, Results found[CASES], Error *error)
{
    const size_t items = CASES, group = 1; // PoCL compiles small groups faster
    const FlatArray array = {.data = cases, .bytes = sizeof cases};
    cl_mem operands = NULL, results = NULL;
    cl_int status;
    cl_kernel kernel = clCreateKernel(program, "repeat_arithmetic", &status);
    bool ok = cl_succeeded(status, "create the kernel of the arithmetic test", error) &&
              buffer_upload(device, &array, &operands, error) &&
              buffer_make(device, NULL, sizeof(Results) * CASES, &results, error);
    if (ok) {
        clSetKernelArg(kernel, 0, sizeof operands, &operands);
        clSetKernelArg(kernel, 1, sizeof results, &results);
        status =
            clEnqueueNDRangeKernel(device->queue, kernel, 1, NULL, &items, &group, 0, NULL, NULL);
        ok = cl_succeeded(status, "run the arithmetic test", error) &&
             buffer_read(device, results, found, sizeof(Results) * CASES, error);
    }
    buffer_release(&operands);
    buffer_release(&results);
    if (kernel != NULL)
        clReleaseKernel(kernel);
    return ok;
}

bool arithmetic_is_exact(const Device *device, cl_program program, const char *options,
                         Error *error)
{
    const bool flushes = strstr(options, "-cl-denorms-are-zero") != NULL;
    const Promise promise = {device->facts.denormals && !flushes, device->facts.correctly_rounded};
    Results found[CASES];
    return launch(device, program, found, error) && compare(device, &promise, found, error);
}
