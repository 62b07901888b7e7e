/* What Python needs of a library, an FMU's or one of its own: a function that gives the addresses
   of all that it calls, or 0 if this processor is too old for them. */
#define TW_LEAST
#include "cpu.h"
#include "symbols.h" /* generated: SYMBOLS(X), X once for each function, in order */

#if defined(_WIN32)
#define SHOWN __declspec(dllexport)
#else
#define SHOWN __attribute__((visibility("default")))
#endif

typedef void (*Function)(void); /* called with its true arguments */
SHOWN const Function *tw_table(void);

#ifdef TW_LEVEL
#define DECLARE(name) extern void TW_JOIN(name, TW_LEVEL)(void);
#define PLACE(name) TW_JOIN(name, TW_LEVEL),
SYMBOLS(DECLARE)
static const Function FUNCTIONS[] = {SYMBOLS(PLACE)};

const Function *tw_table(void) { return FUNCTIONS; }
#else
#define DECLARE(name)            \
    extern void name##_v2(void); \
    extern void name##_v3(void);
#define PLACE_V2(name) name##_v2,
#define PLACE_V3(name) name##_v3,
SYMBOLS(DECLARE)
static const Function FUNCTIONS_V2[] = {SYMBOLS(PLACE_V2)};
static const Function FUNCTIONS_V3[] = {SYMBOLS(PLACE_V3)};

const Function *tw_table(void) {
    if (!is_v2()) return 0;
    return is_v3() ? FUNCTIONS_V3 : FUNCTIONS_V2;
}
#endif
