// SPDX-License-Identifier: MIT
// Sine and cosine of degrees by fixed polynomials: the C library's differ in their last
// bits between processors with and without fma, and a camera made with them would too.
#pragma once

// Within 2 ulp; exact at multiples of 90 (sine, cosine).  degrees must be finite and below 1e9.
double sine_of_degrees(double degrees);
double cosine_of_degrees(double degrees);
