#pragma once

#include "UObject/Object.h"

class FFeedbackContext;

class UFactory : public UObject
{
	STUB_CLASS(UFactory, UObject)

	virtual UObject* FactoryCreateFile(UClass* InClass, UObject* InParent, FName InName, EObjectFlags Flags,
		const FString& Filename, const TCHAR* Parms, FFeedbackContext* Warn, bool& bOutOperationCanceled) = 0;

	UClass* SupportedClass = nullptr;
	TArray<FString> Formats;
	uint8 bCreateNew : 1 = 0;
	uint8 bEditorImport : 1 = 0;
};
