# generate_duktape(<folder>): makes JET's Duktape in <folder> out of the source that Debian's duktape-dev ships.
#
# Duktape's own options (duk_overrides.h) go where its duk_config.h leaves room for them. Its execution timeout looks at the
# clock only between bytecode instructions, so native loops (`new Array(2e9).join('')`, a backtracking regular expression, a
# search in a huge string) would run on for minutes; the edits below put JET_SCRIPT_TICK into them. Each edit must find its
# places, all of them: another version of Duktape stops the configuration instead of silently losing a limit.
#
# Instead of the edits: a watchdog thread cannot stop native code, and a child process per game costs every property access.

find_path(JET_DUKTAPE_SOURCE_DIR duktape.c PATHS /usr/share/duktape NO_DEFAULT_PATH DOC "Folder of duktape.c 2.7, duktape.h, duk_config.h")
set(JET_DUKTAPE_RULES_DIR "${CMAKE_CURRENT_LIST_DIR}")

# Replaces `old`, which must occur exactly `times` in the variable `text`, by `new`.
function(jet_duktape_edit text times old new)
    string(REPLACE "${old}" "" rest "${${text}}")
    string(LENGTH "${${text}}" before)
    string(LENGTH "${rest}" after)
    string(LENGTH "${old}" each)
    math(EXPR found "(${before} - ${after}) / ${each}")
    if(NOT found EQUAL times)
        message(FATAL_ERROR "generate_duktape: expected ${times}, found ${found} occurrences in the sources in ${JET_DUKTAPE_SOURCE_DIR} of\n"
            "  ${old}\nIs it Duktape 2.7? The limits on running scripts depend on it; see plugins/script-duktape/generate_duktape.cmake.")
    endif()
    string(REPLACE "${old}" "${new}" result "${${text}}")
    set(${text} "${result}" PARENT_SCOPE)
endfunction()

function(jet_duktape_write file content)
    file(WRITE "${file}.new" "${content}")
    file(COPY_FILE "${file}.new" "${file}" ONLY_IF_DIFFERENT)
    file(REMOVE "${file}.new")
endfunction()

function(generate_duktape folder)
    if(NOT JET_DUKTAPE_SOURCE_DIR)
        message(FATAL_ERROR "Duktape's source was not found. Install the package duktape-dev, "
            "or set JET_DUKTAPE_SOURCE_DIR to the folder of duktape.c 2.7.")
    endif()
    file(READ "${JET_DUKTAPE_SOURCE_DIR}/duk_config.h" config)
    file(READ "${JET_DUKTAPE_SOURCE_DIR}/duktape.c" source)

    jet_duktape_edit(config 1 "/* __OVERRIDE_DEFINES__ */" "#include \"duk_overrides.h\"")

    # Look at the clock every 4,096 instructions instead of every 262,144: one of them may copy megabytes.
    jet_duktape_edit(source 1 "#define DUK_HTHREAD_INTCTR_DEFAULT (256L * 1024L)" "#define DUK_HTHREAD_INTCTR_DEFAULT (4L * 1024L)")
    jet_duktape_edit(source 1 "#define DUK_RE_EXECUTE_STEPS_LIMIT 1000000000L" "#define DUK_RE_EXECUTE_STEPS_LIMIT 1000000L")
    # Without finalizers two collections free all there is, the second with compaction. What then still fails is told,
    # and the next instruction asks whether to go on, before a script that caught the error makes the heap be searched again.
    jet_duktape_edit(source 1 "#define DUK_HEAP_ALLOC_FAIL_MARKANDSWEEP_LIMIT \\\n\t10" "#define DUK_HEAP_ALLOC_FAIL_MARKANDSWEEP_LIMIT \\\n\t2")
    jet_duktape_edit(source 1 "#define DUK_HEAP_ALLOC_FAIL_MARKANDSWEEP_EMERGENCY_LIMIT \\\n\t3"
        "#define DUK_HEAP_ALLOC_FAIL_MARKANDSWEEP_EMERGENCY_LIMIT \\\n\t2")
    foreach(kind alloc realloc realloc_indirect)
        jet_duktape_edit(source 1 "DUK_D(DUK_DPRINT(\"duk_heap_mem_${kind}() failed even after gc"
            "if (heap->ms_prevent_count == 0) {\n\t\tjet_script_out_of_memory(heap->heap_udata);\n\t\tif (heap->curr_thread) {\n\t\t\theap->curr_thread->interrupt_counter = 0;\n\t\t}\n\t}\n\tDUK_D(DUK_DPRINT(\"duk_heap_mem_${kind}() failed even after gc")
    endforeach()

    # Property access by native code: the loops of Array.prototype, JSON, sort.
    foreach(access getprop hasprop putprop delprop)
        jet_duktape_edit(source 1 "DUK_DDD(DUK_DDDPRINT(\"${access}: thr=%p" "JET_SCRIPT_TICK(thr, 1);\n\tDUK_DDD(DUK_DDDPRINT(\"${access}: thr=%p")
    endforeach()
    # New strings and buffers, by their length.
    jet_duktape_edit(source 1 "\tres = duk_heap_strtable_intern(thr->heap, str, blen);"
        "\tJET_SCRIPT_TICK(thr, blen >> 6);\n\tres = duk_heap_strtable_intern(thr->heap, str, blen);")
    jet_duktape_edit(source 1 "\th = duk_hbuffer_alloc(thr->heap, size, flags, &buf_data);\n\tif (DUK_UNLIKELY(h == NULL)) {\n\t\tDUK_ERROR_ALLOC_FAILED(thr);"
        "\tJET_SCRIPT_TICK(thr, size >> 6);\n\th = duk_hbuffer_alloc(thr->heap, size, flags, &buf_data);\n\tif (DUK_UNLIKELY(h == NULL)) {\n\t\tDUK_ERROR_ALLOC_FAILED(thr);")
    foreach(copy "fast path: able to use memmove() because" "overlap check: p_src_base=%p, src_length")
        jet_duktape_edit(source 1 "DUK_DDD(DUK_DDDPRINT(\"${copy}" "JET_SCRIPT_TICK(thr, dst_length >> 4);\n\t\tDUK_DDD(DUK_DDDPRINT(\"${copy}")
    endforeach()
    # Text: a search compares its whole pattern at each place, characters are decoded one by one, tokens are read.
    jet_duktape_edit(source 3 "if (duk_memcmp((const void *) p, (const void *) q_start, (size_t) q_blen) == 0) {"
        "JET_SCRIPT_TICK(thr, 1 + (q_blen >> 6));\n\t\t\t\tif (duk_memcmp((const void *) p, (const void *) q_start, (size_t) q_blen) == 0) {")
    jet_duktape_edit(source 1 "\t\t\trc = duk_js_string_compare(h1, h2);"
        "\t\t\tJET_SCRIPT_TICK(thr, DUK_HSTRING_GET_BYTELEN(h1) >> 6);\n\t\t\trc = duk_js_string_compare(h1, h2);")
    jet_duktape_edit(source 1 "\tret = duk_js_string_compare(h1, h2);"
        "\tJET_SCRIPT_TICK(thr, DUK_HSTRING_GET_BYTELEN(h1) >> 6);\n\tret = duk_js_string_compare(h1, h2);")
    jet_duktape_edit(source 1 "\trc = (duk_small_int_t) duk_memcmp((const void *) DUK_HSTRING_GET_DATA(h1),"
        "\tJET_SCRIPT_TICK(thr, prefix_len >> 6);\n\trc = (duk_small_int_t) duk_memcmp((const void *) DUK_HSTRING_GET_DATA(h1),")
    foreach(scan "forwards(p_start + sce->bidx, p_end, dist_sce" "backwards(p_start + sce->bidx, p_start, dist_sce"
            "forwards(p_start, p_end, dist_start" "backwards(p_end, p_start, dist_end")
        string(REGEX MATCH "dist_[a-z]+$" distance "${scan}")
        jet_duktape_edit(source 1 "p_found = duk__scan_${scan});" "JET_SCRIPT_TICK(thr, ${distance} >> 6);\n\t\tp_found = duk__scan_${scan});")
    endforeach()
    jet_duktape_edit(source 1 "\tif (duk_unicode_decode_xutf8(thr, ptr, ptr_start, ptr_end, &cp)) {\n\t\treturn cp;"
        "\tJET_SCRIPT_TICK(thr, 1);\n\tif (duk_unicode_decode_xutf8(thr, ptr, ptr_start, ptr_end, &cp)) {\n\t\treturn cp;")
    jet_duktape_edit(source 1 "\t\tre_ctx->steps_count++;" "\t\tre_ctx->steps_count++;\n\t\tJET_SCRIPT_TICK(re_ctx->thr, 1);")
    jet_duktape_edit(source 1 "\t\t\tn = duk__bc_get_u32(re_ctx, &pc);\n\t\t\tc = duk__inp_get_cp(re_ctx, &sp);"
        "\t\t\tn = duk__bc_get_u32(re_ctx, &pc);\n\t\t\tJET_SCRIPT_TICK(re_ctx->thr, n);\n\t\t\tc = duk__inp_get_cp(re_ctx, &sp);")
    jet_duktape_edit(source 2 "\tif (++lex_ctx->token_count >= lex_ctx->token_limit) {"
        "\tJET_SCRIPT_TICK(lex_ctx->thr, 4);\n\tif (++lex_ctx->token_count >= lex_ctx->token_limit) {")

    file(MAKE_DIRECTORY "${folder}")
    jet_duktape_write("${folder}/duk_config.h" "${config}")
    jet_duktape_write("${folder}/duktape.cpp" "${source}")
    configure_file("${JET_DUKTAPE_SOURCE_DIR}/duktape.h" "${folder}/duktape.h" COPYONLY)
    configure_file("${JET_DUKTAPE_RULES_DIR}/duk_overrides.h" "${folder}/duk_overrides.h" COPYONLY)
endfunction()
