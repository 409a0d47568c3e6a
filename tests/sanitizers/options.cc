// The options of the sanitizers, for every test and for the program. In an environment variable
// they would be lost: gtest_discover_tests passes on only the first variable of a list.
// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
extern "C" {
const char* __asan_default_options();
const char* __asan_default_options() { return "detect_stack_use_after_return=1"; }
const char* __ubsan_default_options();
const char* __ubsan_default_options() { return "print_stacktrace=1"; }
// These libraries keep fonts until the process ends. Cairo 1.16 loses 472 bytes, an analysis of the
// page, for each group with an opacity that its SVG surface paints and lets go of before the
// surface is finished, also if the whole program is cairo_push_group, cairo_pop_group_to_source and
// cairo_paint_with_alpha. Its functions have no names that a narrower suppression could give.
const char* __lsan_default_options();
const char* __lsan_default_options() { return "print_suppressions=0"; }
const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\nleak:libcairo\nleak:libpango\nleak:librsvg\n";
}
// CHOLMOD starts threads of OpenMP, which are not compiled for the thread sanitizer: it does not
// see that they wait for each other. No code of ours runs in such a thread.
const char* __tsan_default_suppressions();
const char* __tsan_default_suppressions() { return "race:libgomp.so\n"; }
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)
