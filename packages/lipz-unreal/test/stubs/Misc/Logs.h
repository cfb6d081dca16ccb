#pragma once

#include "Containers/Strings.h"

namespace ELogVerbosity
{
enum Type { Error, Warning, Display, Log };
}

/** Everything that was logged, for tests. */
extern std::vector<std::string> StubLog;

class FOutputDevice
{
public:
	template <typename... T> void Logf(ELogVerbosity::Type, const TCHAR* Format, T... Arguments)
	{
		StubLog.push_back(StubFormat(Format, {StubArgument(Arguments)...}));
	}
};

struct FStubCategory {};
#define DECLARE_LOG_CATEGORY_EXTERN(Name, Default, Compiled) extern FStubCategory Name
#define DEFINE_LOG_CATEGORY(Name) FStubCategory Name
#define UE_LOG(Category, Verbosity, Format, ...) \
	((void)Category, FOutputDevice().Logf(ELogVerbosity::Verbosity, Format __VA_OPT__(, ) __VA_ARGS__))
