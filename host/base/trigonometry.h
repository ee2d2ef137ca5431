// SPDX-License-Identifier: MIT
// Sine and cosine of degrees by fixed polynomials. The C library's last bits differ between
// processors with and without fma, and would change the camera.
#pragma once

// Accurate within 2 ulp; exact at multiples of 90. degrees must be finite and below 1e9.
double sine_of_degrees(double degrees);
double cosine_of_degrees(double degrees);
