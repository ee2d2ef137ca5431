// SPDX-License-Identifier: MIT
// Devices without fp64 can compile the kernels: without CLRT_FP64, no line names a double.
#include "kernel/doubles.h"
#include "unit/cmocka_all.h"

// Generated at build time. certify.cl is missing, because it is compiled only with fp64.
extern const char kernel_source[], rays_source[], samples_source[], aov_source[], explain_source[];

TEST(every_double_that_is_compiled_without_fp64_is_found)
{
    static const struct {
        const char *text;
        size_t count;
    } cases[] = {
        {"", 0},
        {"float a;\ndouble b;\n", 1},
        {"double a;\ndouble2 b; double c;\nconvert_double(d)", 3},
        {"float a; // not a double\n// double\n", 0},
        {"double a; // indeed a double\n", 1},
        {"#if CLRT_FP64\ndouble a;\n#else\nfloat a;\n#endif\n", 0},
        {"#if CLRT_FP64\nfloat a;\n#else\ndouble a;\n#endif\n", 1},
        {"#if CLRT_FP64\n#endif\ndouble a;\n", 1},
        {"#if !CLRT_FP64\ndouble a;\n#else\ndouble b;\n#endif\n", 1},
        {"#if CLRT_FP64\n#if A\n#else\n#endif\ndouble a;\n#endif\n", 0},
        {"#if A\n#if CLRT_FP64\n#endif\ndouble a;\n#endif\n", 1},
        {"#if A\ndouble a;\n#else\ndouble b;\n#endif\n", 2},
        {"#if CLRT_FP64\n#elif A\ndouble a;\n#endif\n", 1},
        {"#if CLRT_FP64 || A\ndouble a;\n#endif\n", 1},
        {"#ifdef CLRT_FP64\ndouble a;\n#endif\n", 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (doubles_without_fp64(cases[i].text) != cases[i].count)
            fail_msg("not %zu doubles in '%s'", cases[i].count, cases[i].text);
}

TEST(kernels_without_fp64_name_no_double)
{
    const char *const sources[] = {kernel_source, rays_source, samples_source, aov_source,
                                   explain_source};
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++)
        assert_int_equal(doubles_without_fp64(sources[i]), 0);
}
