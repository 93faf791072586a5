# The OpenGL loader: glad 2 writes one header and one source from its bundled registry, without the network.
function(lobe_generate_glad out_dir)
  if(NOT EXISTS ${out_dir}/src/gl.c)
    find_program(LOBE_GLAD_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
    if(NOT LOBE_GLAD_PYTHON)
      find_program(LOBE_GLAD_PYTHON NAMES python3 REQUIRED)
    endif()
    execute_process(
      COMMAND ${LOBE_GLAD_PYTHON} -m glad --quiet --reproducible --out-path ${out_dir}
              --api gl:core=3.3
              --extensions GL_ARB_clip_control,GL_KHR_debug,GL_ARB_timer_query,GL_EXT_texture_filter_anisotropic,GL_ARB_texture_filter_anisotropic
              c
      RESULT_VARIABLE failed ERROR_VARIABLE why)
    if(failed)
      message(FATAL_ERROR "glad could not write the OpenGL loader (package python3-glad): ${why}")
    endif()
  endif()
endfunction()
