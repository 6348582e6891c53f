# How everything of ours is compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# same bits everywhere: no fused or reordered arithmetic
add_compile_options(-ffp-contract=off)
# functions may be inlined where -fPIC is, as Clang does
add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)

if(HURCULES_ASSERTS)
  add_compile_options(-UNDEBUG)
endif()
