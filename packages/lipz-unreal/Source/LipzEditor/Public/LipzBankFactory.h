#pragma once

#include "CoreMinimal.h"
#include "EditorReimportHandler.h"
#include "Factories/Factory.h"

#include "LipzBankFactory.generated.h"

class ULipzBank;

/** Imports .lipzbank files, and checks every byte of them. */
UCLASS()
class LIPZEDITOR_API ULipzBankFactory : public UFactory, public FReimportHandler
{
	GENERATED_BODY()

public:
	ULipzBankFactory();

	virtual UObject* FactoryCreateFile(UClass* InClass, UObject* InParent, FName InName, EObjectFlags Flags,
		const FString& Filename, const TCHAR* Parms, FFeedbackContext* Warn, bool& bOutOperationCanceled) override;

	virtual bool CanReimport(UObject* Object, TArray<FString>& OutFilenames) override;
	virtual void SetReimportPaths(UObject* Object, const TArray<FString>& NewReimportPaths) override;
	virtual EReimportResult::Type Reimport(UObject* Object) override;

private:
	/** Reads a file into a bank. If it is damaged, reports it and leaves the bank as it was. */
	static bool Import(ULipzBank& Bank, const FString& Filename, FOutputDevice& Log);
};
