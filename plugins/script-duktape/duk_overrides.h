/* JET's choices for Duktape, included by the generated duk_config.h in the place it keeps for them. */
#ifndef JET_DUK_OVERRIDES_H
#define JET_DUK_OVERRIDES_H

struct duk_hthread;

#ifdef __cplusplus
extern "C" {
#endif
/* Defined in limits.cpp. `udata` is the heap's Budget, whose first member is the fuel counted down by JET_SCRIPT_TICK. */
int jet_script_timed_out(void *udata);
void jet_script_out_of_memory(void *udata);
int jet_script_stack_is_low(void *udata);
void jet_script_checkpoint(struct duk_hthread *thr);
double jet_script_now_ms(struct duk_hthread *thr);
double jet_script_random(void *udata);
#ifdef __cplusplus
}
#endif

/* Native functions of the plugin hold C++ objects: an error must unwind them. */
#define DUK_USE_CPP_EXCEPTIONS

/* Limits. */
#define DUK_USE_INTERRUPT_COUNTER
#define DUK_USE_EXEC_TIMEOUT_CHECK(udata) jet_script_timed_out(udata)
#define DUK_USE_NATIVE_STACK_CHECK() jet_script_stack_is_low(thr->heap->heap_udata)
#define JET_SCRIPT_TICK(thr, cost) \
	do { \
		int *jet_fuel = (int *) (thr)->heap->heap_udata; \
		if ((*jet_fuel -= (int) (cost)) < 0) { \
			jet_script_checkpoint(thr); \
		} \
	} while (0)
#undef DUK_USE_CALLSTACK_LIMIT
#define DUK_USE_CALLSTACK_LIMIT 5000

/* The same run gives the same bits: simulated time, the simulation's random numbers, no time zone. */
#undef DUK_USE_DATE_GET_NOW
#define DUK_USE_DATE_GET_NOW(ctx) jet_script_now_ms(ctx)
#undef DUK_USE_DATE_GET_LOCAL_TZOFFSET
#undef DUK_USE_DATE_TZO_GMTIME_R
#undef DUK_USE_DATE_TZO_GMTIME
#define DUK_USE_DATE_GET_LOCAL_TZOFFSET(d) ((duk_int_t) 0)
#undef DUK_USE_DATE_PRS_STRPTIME /* reads what the locale says; ISO 8601 remains */
#undef DUK_USE_DATE_FMT_STRFTIME
#define DUK_USE_GET_RANDOM_DOUBLE(udata) jet_script_random(udata)
#define DUK_USE_GET_MONOTONIC_TIME(thr) jet_script_now_ms(thr)

/* Bytecode can be forged. (Coroutines, finalizers, CBOR and performance.now stay compiled in, the table of built-ins in
 * duktape.c names them; heap.cpp takes them away from scripts.) */
#undef DUK_USE_BYTECODE_DUMP_SUPPORT

/* Nothing of Duktape leaves the plugin: another library may bring its own. */
#undef DUK_EXTERNAL_DECL
#define DUK_EXTERNAL_DECL extern
#undef DUK_EXTERNAL
#define DUK_EXTERNAL

#endif
