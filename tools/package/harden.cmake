# SPDX-License-Identifier: MIT
# Makes memory faults harder to exploit: checked string functions, stack protectors, addresses that
# differ in every run, and read-only tables of functions.
include(CheckCCompilerFlag)
include(CheckPIESupported)
check_pie_supported(LANGUAGES C)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

target_compile_options(
  clrt_hardening INTERFACE -fstack-protector-strong -fstack-clash-protection -Wformat
                           -Werror=format-security -U_FORTIFY_SOURCE
                           $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=3>)
check_c_compiler_flag(-fcf-protection has_cf_protection) # processors of Intel and AMD
if(has_cf_protection)
  target_compile_options(clrt_hardening INTERFACE -fcf-protection)
endif()
target_link_options(clrt_hardening INTERFACE -Wl,-z,relro,-z,now)
