# A local name may stand for something else in a source that is compiled with it.
add_library(cairn_local_names INTERFACE)
target_compile_options(cairn_local_names INTERFACE -Wno-shadow)

# Most of a compilation is reading and instantiating Eigen, which sources that are compiled together share. Names in
# unnamed namespaces must then differ within a target. `make tidy` compiles every source alone.
#   cairn_compile_together(TARGET [SOURCES_AT_ONCE])
# All at once (0) is the least work; fewer are less for who changes one of them.
function(cairn_compile_together target)
  if(NOT CAIRN_UNITY)
    return()
  endif()
  set(sources_at_once 0)
  if(ARGC GREATER 1)
    set(sources_at_once ${ARGV1})
  endif()
  if(sources_at_once EQUAL 0)
    target_link_libraries(${target} PRIVATE cairn_local_names)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${sources_at_once})
  # g++ takes a source that is included for a header, in which members of unnamed namespaces would be a mistake.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
