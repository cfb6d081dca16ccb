#pragma once

#include "UObject/Object.h"

class FStringTable;

class UStringTable : public UObject
{
	STUB_CLASS(UStringTable, UObject)

	UStringTable();
	FName GetStringTableId() const { return FName(*StubName); }
	TSharedRef<FStringTable> GetStringTable() const { return StubTable; }

	TSharedRef<FStringTable> StubTable;
};
