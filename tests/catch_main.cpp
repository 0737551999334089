// The main function of every suite, for a Catch2 that does not bring its own.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
