# SPDX-License-Identifier: MIT
# Guards against memory faults that slipped through: checked string functions, stack protectors,
# addresses that differ in every run, tables of functions that cannot be written.
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
