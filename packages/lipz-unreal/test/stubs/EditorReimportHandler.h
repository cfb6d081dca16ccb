#pragma once

#include "UObject/Object.h"

namespace EReimportResult
{
enum Type { Failed, Succeeded, Cancelled };
}

class FReimportHandler
{
public:
	virtual ~FReimportHandler() = default;
	virtual bool CanReimport(UObject* Object, TArray<FString>& OutFilenames) = 0;
	virtual void SetReimportPaths(UObject* Object, const TArray<FString>& NewReimportPaths) = 0;
	virtual EReimportResult::Type Reimport(UObject* Object) = 0;
};
